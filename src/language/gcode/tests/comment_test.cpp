#include "parsed_line.hpp"

namespace passo {
namespace {

using Kind = BlockComment::Kind;

TEST(Comments, stand_anywhere_between_words) {
  const ParsedLine line("(a) G1 (b c) X1 ; d (e)");
  ASSERT_TRUE(line.good);
  ASSERT_EQ(line.block.comments.size(), 3U);
  EXPECT_EQ(line.block.comments[0].text, "a");
  EXPECT_EQ(line.block.comments[1].text, "b c");
  EXPECT_EQ(line.block.comments[2].text, " d (e)");
  EXPECT_EQ(line.block.comments[1].span, (Span{8, 5}));
  EXPECT_EQ(line.block.comments[2].span, (Span{17, 7}));
  EXPECT_EQ(line.block.words.size(), 2U);
}

TEST(Comments, keep_any_bytes) {
  const ParsedLine line("(50\xC2\xB0 \x01 #1 \xFF;)");
  ASSERT_TRUE(line.good);
  EXPECT_EQ(line.block.comments[0].text, "50\xC2\xB0 \x01 #1 \xFF;");
}

TEST(Comments, are_active_with_a_keyword_in_any_case_and_spacing) {
  const auto kind_and_text = [](const std::string& text) {
    const ParsedLine line("(" + text + ")");
    EXPECT_TRUE(line.good);
    return std::pair(line.block.comments.at(0).kind, std::string(line.block.comments.at(0).text));
  };
  EXPECT_EQ(kind_and_text("MSG, Hello World"), std::pair(Kind::message, std::string(" Hello World")));
  EXPECT_EQ(kind_and_text("  m S g ,x"), std::pair(Kind::message, std::string("x")));
  EXPECT_EQ(kind_and_text("debug,#1"), std::pair(Kind::debug, std::string("#1")));
  EXPECT_EQ(kind_and_text("PRINT,a,b"), std::pair(Kind::print, std::string("a,b")));
  EXPECT_EQ(kind_and_text("LOG,"), std::pair(Kind::log, std::string()));
  EXPECT_EQ(kind_and_text("LOGOPEN,f"), std::pair(Kind::log_open, std::string("f")));
  EXPECT_EQ(kind_and_text("LogAppend,f"), std::pair(Kind::log_append, std::string("f")));
  EXPECT_EQ(kind_and_text("ABORT,x"), std::pair(Kind::abort, std::string("x")));
  EXPECT_EQ(kind_and_text("LOGCLOSE"), std::pair(Kind::log_close, std::string()));
  EXPECT_EQ(kind_and_text("PROBEOPEN f.txt"), std::pair(Kind::probe_open, std::string(" f.txt")));
  EXPECT_EQ(kind_and_text("probeopen,f.txt"), std::pair(Kind::probe_open, std::string("f.txt")));
  EXPECT_EQ(kind_and_text("PROBECLOSE"), std::pair(Kind::probe_close, std::string()));
}

TEST(Comments, are_plain_without_the_comma_or_with_another_word) {
  for (const char* text : {"MSG hello", "MSGS,hello", "hello, MSG,", "probeopening", "logcloses", "", ",", "M-SG,"}) {
    const ParsedLine line("(" + std::string(text) + ")");
    ASSERT_TRUE(line.good);
    EXPECT_EQ(line.block.comments[0].kind, Kind::plain) << text;
    EXPECT_EQ(line.block.comments[0].text, text);
  }
}

TEST(Comments, after_a_semicolon_are_never_active_as_in_linuxcnc) {
  const ParsedLine line(";MSG,hello");
  ASSERT_TRUE(line.good);
  EXPECT_EQ(line.block.comments[0].kind, Kind::plain);
  EXPECT_EQ(line.printed(), ";MSG,hello");
}

TEST(Comments, that_are_not_closed_are_shown_where_they_open) {
  EXPECT_EQ(ParsedLine("G1 X1 (feed").fault_at(), "gcode.unclosed-comment 7 1");
  EXPECT_EQ(ParsedLine("(a) (").fault_at(), "gcode.unclosed-comment 5 1");
}

TEST(Comments, do_not_nest) {
  EXPECT_EQ(ParsedLine("G1 (a (b) c)").fault_at(), "gcode.nested-comment 7 1");
  EXPECT_EQ(ParsedLine("G1 (a) b)").fault_at(), "gcode.missing-value 9 1");
  EXPECT_EQ(ParsedLine("G1 X1 )").fault_at(), "gcode.unexpected-text 7 1");
}

}  // namespace
}  // namespace passo
