#include "parsed_line.hpp"

namespace passo {
namespace {

TEST(OWords, know_every_keyword) {
  const std::pair<const char*, ControlKind> all[] = {
      {"sub", ControlKind::sub},
      {"endsub", ControlKind::endsub},
      {"call", ControlKind::call},
      {"return", ControlKind::return_},
      {"do", ControlKind::do_},
      {"while [1]", ControlKind::while_},
      {"endwhile", ControlKind::endwhile},
      {"if [1]", ControlKind::if_},
      {"elseif [1]", ControlKind::elseif},
      {"else", ControlKind::else_},
      {"endif", ControlKind::endif},
      {"repeat [1]", ControlKind::repeat},
      {"endrepeat", ControlKind::endrepeat},
      {"break", ControlKind::break_},
      {"continue", ControlKind::continue_},
      {"", ControlKind::program},
  };
  for (const auto& [text, kind] : all) {
    const ParsedLine line(std::string("o100 ") + text);
    ASSERT_TRUE(line.good) << text << render(line.diagnostics, false);
    EXPECT_EQ(line.block.control->kind, kind);
    EXPECT_EQ(line.symbols.name(line.block.control->label), "100");
  }
}

TEST(OWords, a_number_and_its_name_are_one_label) {
  SymbolTable symbols;
  const BlockParser parser("part.ngc", symbols);
  Diagnostics diagnostics;
  const auto label = [&](const char* text) {
    Block block;
    EXPECT_TRUE(parser.parse(text, 1, block, diagnostics)) << text;
    return block.control->label;
  };
  const Symbol expected = label("o100 sub");
  EXPECT_EQ(label("O<100> call"), expected);
  EXPECT_EQ(label("o 1 0 0 call"), expected);
  EXPECT_EQ(label("o100.0 call"), expected);
  EXPECT_EQ(label("o[100] call"), expected);
  EXPECT_NE(label("o101 call"), expected);
  EXPECT_EQ(label("o<Square Pocket> call"), label("O<squarepocket>sub"));
}

TEST(OWords, may_compute_their_label) {
  const ParsedLine line("o[#1+2] call");
  ASSERT_TRUE(line.good);
  EXPECT_FALSE(line.block.control->label);
  ASSERT_TRUE(line.block.control->computed_label);
  EXPECT_EQ(line.block.control->computed_label->count, 4U);
  EXPECT_EQ(line.printed(), "O[#1 + 2] CALL");
  EXPECT_EQ(ParsedLine("o#5 call").printed(), "O[#5] CALL");
}

TEST(OWords, calls_take_arguments_with_comments_between) {
  const ParsedLine line("o<x> call [1] (c) [#2+3][sin[4]] ; d");
  ASSERT_TRUE(line.good);
  EXPECT_EQ(line.block.control->arguments.size(), 3U);
  EXPECT_EQ(line.block.comments.size(), 2U);
  EXPECT_EQ(line.block.control->span, (Span{1, 32}));
  EXPECT_EQ(line.printed(), "O<x> CALL [1] [#2 + 3] [SIN[4]] (c) ; d");
}

TEST(OWords, return_and_endsub_take_at_most_one_value) {
  EXPECT_EQ(ParsedLine("o1 return [#1]").block.control->arguments.size(), 1U);
  EXPECT_EQ(ParsedLine("o1 endsub [2]").block.control->arguments.size(), 1U);
  EXPECT_EQ(ParsedLine("o1 return [1] [2]").fault_at(), "gcode.unexpected-text 15 1");
}

TEST(OWords, come_after_block_delete_and_line_number) {
  const ParsedLine line("/N5 o1 if [#1 gt 2] (c)");
  ASSERT_TRUE(line.good);
  EXPECT_TRUE(line.block.block_delete);
  EXPECT_EQ(line.block.control->kind, ControlKind::if_);
}

TEST(OWords, without_a_condition_are_shown) {
  EXPECT_EQ(ParsedLine("o1 if").fault_at(), "gcode.missing-value 4 2");
  EXPECT_EQ(ParsedLine("o1 while #1").fault_at(), "gcode.missing-value 4 5");
}

TEST(OWords, suggest_the_keyword_that_was_meant) {
  const ParsedLine line("o100 sbu");
  EXPECT_EQ(line.fault_at(), "gcode.bad-o-word 6 3");
  EXPECT_EQ(line.fault().expected, "SUB, perhaps");
  EXPECT_EQ(ParsedLine("o100 endrepeet").fault().expected, "ENDREPEAT, perhaps");
}

TEST(OWords, need_a_label_and_a_keyword) {
  EXPECT_EQ(ParsedLine("o call").fault_at(), "gcode.bad-o-word 1 1");
  EXPECT_EQ(ParsedLine("o").fault_at(), "gcode.bad-o-word 1 1");
  EXPECT_EQ(ParsedLine("o1.5 call").fault_at(), "gcode.bad-o-word 2 3");
  EXPECT_EQ(ParsedLine("o100 [1]").fault_at(), "gcode.bad-o-word 6 1");
  EXPECT_EQ(ParsedLine("o<> call").fault_at(), "gcode.bad-parameter-name 2 2");
}

TEST(OWords, share_their_line_with_comments_only) {
  EXPECT_EQ(ParsedLine("o100 endsub G0").fault_at(), "gcode.bad-o-word 6 8");
  EXPECT_EQ(ParsedLine("o100 call [1] G0").fault_at(), "gcode.unexpected-text 15 1");
  EXPECT_EQ(ParsedLine("G0 X1 o100 call").fault_at(), "gcode.bad-o-word 7 1");
}

}  // namespace
}  // namespace passo
