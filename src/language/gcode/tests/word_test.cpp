#include "parsed_line.hpp"

namespace passo {
namespace {

std::string letters(const ParsedLine& line) {
  std::string all;
  for (const Word& word : line.block.words) all += word.letter;
  return all;
}

TEST(Words, are_letters_with_values_in_their_order) {
  const ParsedLine line("G1 x12.345Y-3.21 z0.5 F100");
  ASSERT_TRUE(line.good);
  EXPECT_EQ(letters(line), "GXYZF");
  EXPECT_EQ(line.value(1), 12.345);
  EXPECT_EQ(line.value(2), -3.21);
}

TEST(Words, know_where_they_stand) {
  const ParsedLine line("G1  X 12.5 \tY-[#1 + 2 ]  Z1");
  ASSERT_TRUE(line.good);
  EXPECT_EQ(line.block.words[0].span, (Span{1, 2}));
  EXPECT_EQ(line.block.words[1].span, (Span{5, 6}));
  EXPECT_EQ(line.block.words[1].value.span, (Span{7, 4}));
  EXPECT_EQ(line.block.words[2].span, (Span{13, 11}));
  EXPECT_EQ(line.block.words[3].span, (Span{26, 2}));
}

TEST(Words, include_the_polar_letters_and_the_spindle_number) {
  const ParsedLine line("G1 @5 ^45 $1");
  ASSERT_TRUE(line.good);
  EXPECT_EQ(letters(line), "G@^$");
}

TEST(Words, take_any_value_with_any_signs) {
  const ParsedLine line("X-[1+2] Y-#1 Zsin[30] A+[2] B--5 C-+2 U-cos[0]");
  ASSERT_TRUE(line.good);
  EXPECT_EQ(line.value(0), -3);
  EXPECT_EQ(line.evaluation(line.block.words[1].value).error().kind, EvaluationError::Kind::unknown_parameter);
  EXPECT_NEAR(line.value(2), 0.5, 1e-15);
  EXPECT_EQ(line.value(3), 2);
  EXPECT_EQ(line.value(4), 5);
  EXPECT_EQ(line.value(5), -2);
  EXPECT_EQ(line.value(6), -1);
}

TEST(Words, a_plain_value_is_one_number_whatever_its_brackets_and_signs) {
  const ParsedLine line("X-[[5]]");
  ASSERT_TRUE(line.good);
  EXPECT_EQ(line.block.words[0].value.count, 1U);
  EXPECT_EQ(line.printed(), "X-5");
}

TEST(Lines, may_be_empty_or_blank) {
  EXPECT_TRUE(ParsedLine("").good);
  EXPECT_TRUE(ParsedLine(" \t ").good);
  EXPECT_TRUE(ParsedLine(" \t ").block.empty());
}

TEST(Lines, start_with_block_delete_and_a_line_number) {
  const ParsedLine line(" / n 12.5 G0");
  ASSERT_TRUE(line.good);
  EXPECT_TRUE(line.block.block_delete);
  EXPECT_EQ(line.block.line_number, "12.5");
  EXPECT_EQ(letters(line), "G");
}

TEST(Lines, a_line_number_alone_is_an_empty_block) {
  const ParsedLine line("N120");
  ASSERT_TRUE(line.good);
  EXPECT_TRUE(line.block.empty());
  EXPECT_EQ(line.block.line_number, "120");
}

TEST(Lines, a_percent_sign_stands_alone) {
  EXPECT_TRUE(ParsedLine(" % ").block.percent);
  EXPECT_EQ(ParsedLine("% G0").fault_at(), "gcode.unexpected-text 3 1");
}

TEST(Lines, keep_their_number_and_text) {
  const ParsedLine line("G0 X1");
  EXPECT_EQ(line.block.line, 7U);
  EXPECT_EQ(line.block.text, "G0 X1");
}

TEST(Lines, a_used_block_keeps_nothing_of_the_line_before) {
  SymbolTable symbols;
  const BlockParser parser("part.ngc", symbols);
  Diagnostics diagnostics;
  Block block;
  ASSERT_TRUE(parser.parse("/N1 G1 X[1+2] #1=2 (MSG,a)", 1, block, diagnostics));
  ASSERT_TRUE(parser.parse("O100 CALL [1] [2]", 2, block, diagnostics));
  EXPECT_EQ(print(block, symbols), "O100 CALL [1] [2]");
  ASSERT_TRUE(parser.parse("O100 CALL [3]", 3, block, diagnostics));
  EXPECT_EQ(print(block, symbols), "O100 CALL [3]");
  ASSERT_TRUE(parser.parse("", 4, block, diagnostics));
  EXPECT_TRUE(block.empty());
  EXPECT_EQ(print(block, symbols), "");
}

TEST(Assignments, take_numbers_names_and_expressions) {
  const ParsedLine line("#1=2 #<Tool Radius>=[1+2] ##2=3 #[1+2]=-#4 # 5 = 6");
  ASSERT_TRUE(line.good) << render(line.diagnostics, false);
  ASSERT_EQ(line.block.assignments.size(), 5U);
  EXPECT_EQ(line.value(*line.block.assignments[0].index), 1);
  EXPECT_FALSE(line.block.assignments[1].index);
  EXPECT_EQ(line.symbols.name(line.block.assignments[1].symbol), "toolradius");
  EXPECT_EQ(line.value(line.block.assignments[1].value), 3);
  EXPECT_EQ(line.value(*line.block.assignments[3].index), 3);
  EXPECT_EQ(line.block.assignments[1].span, (Span{6, 20}));
  EXPECT_EQ(line.printed(), "#1=2 #<toolradius>=[1 + 2] ##2=3 #[1 + 2]=-#4 #5=6");
}

TEST(Assignments, stand_beside_words) {
  const ParsedLine line("#1=1 G0 X5 #2=[#1+7]");
  ASSERT_TRUE(line.good);
  EXPECT_EQ(line.block.words.size(), 2U);
  EXPECT_EQ(line.block.assignments.size(), 2U);
}

TEST(Names, are_compared_without_case_and_blanks) {
  SymbolTable symbols;
  const Symbol name = symbols.intern("Feed Rate");
  EXPECT_EQ(symbols.intern("fEEdrAte\t"), name);
  EXPECT_EQ(symbols.name(name), "feedrate");
  EXPECT_NE(symbols.intern("feedrate2"), name);
  EXPECT_EQ(symbols.size(), 3U);  // includes the empty symbol
}

TEST(Names, stay_where_they_are_while_the_table_grows) {
  SymbolTable symbols;
  const std::string_view first = symbols.name(symbols.intern("a"));
  for (int i = 0; i < 10'000; ++i) symbols.intern("name" + std::to_string(i));
  EXPECT_EQ(first, "a");
  EXPECT_EQ(symbols.intern("NAME 77"), symbols.intern("name77"));
  EXPECT_EQ(symbols.name(symbols.intern(std::string(3000, 'Q'))), std::string(3000, 'q'));
}

TEST(Names, may_have_letters_outside_ascii) {
  const ParsedLine line("#<größe>=3");
  ASSERT_TRUE(line.good);
  EXPECT_EQ(line.symbols.name(line.block.assignments[0].symbol), "größe");
}

}  // namespace
}  // namespace passo
