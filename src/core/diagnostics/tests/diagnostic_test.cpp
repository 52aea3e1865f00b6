#include "passo/diagnostics/shown_location.hpp"

namespace passo {
namespace {

Diagnostic missing_feed() {
  return {.code = "gcode.missing-feed",
          .file = "part.ngc",
          .place = {.line = 3, .column = 4, .length = 3},
          .message = "no feed rate is set",
          .expected = "F before the first feed move, or on it",
          .text = "G1 X10"};
}

TEST(Render, points_at_the_place_and_says_what_was_expected) {
  EXPECT_EQ(render(missing_feed(), false),
            "part.ngc:3:4: error: no feed rate is set [gcode.missing-feed]\n"
            "    3 | G1 X10\n"
            "      |    ^~~\n"
            "      = expected: F before the first feed move, or on it\n");
}

TEST(Render, names_the_first_of_the_other_lines) {
  Diagnostics diagnostics;
  Diagnostic warning = missing_feed();
  warning.severity = Severity::warning;
  EXPECT_FALSE(diagnostics.count_repeated(warning.code, warning.file, 9)) << "nothing is kept yet";
  diagnostics.add(warning);
  for (const std::uint32_t line : {9U, 3U, 5U, 9U, 7U, 11U}) {
    EXPECT_TRUE(diagnostics.count_repeated(warning.code, warning.file, line));
  }
  EXPECT_FALSE(diagnostics.count_repeated(warning.code, "sub.ngc", 9));
  warning.place.line = 12;
  diagnostics.add(warning);
  ASSERT_EQ(diagnostics.all().size(), 1U);
  EXPECT_EQ(diagnostics.all()[0].more_lines, (std::vector<std::uint32_t>{5, 7, 9, 11, 12}));
  EXPECT_EQ(more_lines_in_words(diagnostics.all()[0]), "and 5 more, lines 5, 7, 9, ...");
  EXPECT_TRUE(render(diagnostics, false).ends_with("      = and 5 more, lines 5, 7, 9, ...\n"));
  for (std::uint32_t line = 100; line < 3000; ++line) diagnostics.count_repeated(warning.code, warning.file, line);
  EXPECT_EQ(more_lines_in_words(diagnostics.all()[0]), "and 1000 or more, lines 5, 7, 9, ...");
}

TEST(Render, shows_a_window_of_a_very_long_line) {
  Diagnostic diagnostic = missing_feed();
  diagnostic.text = std::string(500'000, 'x');
  diagnostic.text += "Q9";
  diagnostic.text.append(500'000, 'y');
  diagnostic.place = {.line = 1, .column = 500'001, .length = 2};
  const std::string text = render(diagnostic, false);
  EXPECT_LT(text.size(), 500U);
  EXPECT_NE(text.find("Q9"), std::string::npos);
  EXPECT_EQ(text.find("Q9") - text.rfind('\n', text.find("Q9")), text.find('^') - text.rfind('\n', text.find('^')));
}

TEST(Render, a_caret_stands_under_its_character_after_letters_outside_ascii) {
  Diagnostic diagnostic = missing_feed();
  diagnostic.text = "(\xC3\xA9\xC3\xA9) X";
  diagnostic.place = {.line = 1, .column = 8, .length = 1};
  EXPECT_NE(render(diagnostic, false).find("      |      ^\n"), std::string::npos);
}

TEST(Render, columns_count_characters_and_not_bytes) {
  Diagnostic diagnostic;
  diagnostic.file = "part.ngc";
  diagnostic.text =
      "(Gr\xC3\xB6\xC3\x9F"
      "e) G0 X\xE2\x88\x92"
      "5";
  diagnostic.place = {.line = 3, .column = 15, .length = 4};
  EXPECT_EQ(shown_location(diagnostic).column, 13U);
  EXPECT_EQ(shown_location(diagnostic).length, 2U);
  EXPECT_EQ(render(diagnostic, false).substr(0, 14), "part.ngc:3:13:");
  diagnostic.text.clear();
  EXPECT_EQ(shown_location(diagnostic).column, 15U) << "nothing is known of the line";
}

TEST(Render, tells_the_rule_and_the_ends_of_a_long_stack_of_calls) {
  Diagnostic diagnostic;
  diagnostic.file = "part.ngc";
  diagnostic.message = "wrong";
  diagnostic.rule = "RS274/NGC 3.4, modal groups";
  for (std::uint32_t line = 1; line <= 9; ++line) diagnostic.calls.push_back({"o1", "part.ngc", line});
  const std::string nine = render(diagnostic, false);
  EXPECT_NE(nine.find("      = rule: RS274/NGC 3.4, modal groups\n      = in o1, called at part.ngc:1\n"),
            std::string::npos);
  EXPECT_EQ(nine.find("more calls"), std::string::npos);
  diagnostic.calls.push_back({"o1", "part.ngc", 10});
  const std::string ten = render(diagnostic, false);
  EXPECT_NE(ten.find("part.ngc:4\n      = ... 2 more calls ...\n      = in o1, called at part.ngc:7\n"),
            std::string::npos)
      << ten;
}

TEST(Render, control_characters_do_not_reach_the_terminal) {
  Diagnostic diagnostic = missing_feed();
  diagnostic.text = "G1 \x1b[31mX10";
  EXPECT_EQ(render(diagnostic, false).find('\x1b'), std::string::npos);
}

TEST(Diagnostics, keeps_the_first_errors_and_counts_the_rest) {
  Diagnostics diagnostics(2);
  for (std::uint32_t line = 1; line <= 5; ++line) {
    Diagnostic diagnostic = missing_feed();
    diagnostic.place.line = line;
    diagnostics.add(diagnostic);
  }
  EXPECT_EQ(diagnostics.all().size(), 2U);
  EXPECT_EQ(diagnostics.errors(), 5U);
  EXPECT_TRUE(diagnostics.full());
  EXPECT_NE(render(diagnostics, false).find("5 errors, the first 2 shown\n"), std::string::npos);
}

TEST(Diagnostics, a_finding_that_comes_again_at_its_place_counts_once) {
  Diagnostics diagnostics;
  for (int i = 0; i < 5; ++i) diagnostics.add(missing_feed());
  EXPECT_EQ(diagnostics.all().size(), 1U);
  EXPECT_EQ(diagnostics.errors(), 1U);
}

TEST(Nearest, finds_the_word_that_was_meant_and_nothing_when_none_is_near) {
  EXPECT_EQ(nearest("travle", {"travel", "velocity"}), "travel");
  EXPECT_EQ(nearest("colour", {"travel", "velocity"}), "");
}

TEST(Suggestion, also_finds_swapped_letters_and_names_that_are_longer_or_shorter) {
  EXPECT_EQ(suggestion("naem", {"clock", "name"}), "name");
  EXPECT_EQ(suggestion("pic", {"passes", "picture"}), "picture");
  EXPECT_EQ(suggestion("velocity_mm_s", {"velocity", "travel"}), "velocity");
  EXPECT_EQ(suggestion("q", {"velocity", "travel"}), "");
}

}  // namespace
}  // namespace passo
