// The parts of ProgramFlow: ProgramLines, RunawayGuard, UnreadableLabels and PercentSigns.
#include "../program_lines.hpp"

#include "../runaway_guard.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

struct LinesOfText {
  explicit LinesOfText(std::string text, ProgramLines::Options options = {})
      : lines(ProgramReader::from_text("part.ngc", std::move(text)), std::move(options), state, parameters, symbols,
              reporter) {}
  SymbolTable symbols;
  ProgramState state;
  Parameters parameters{symbols, state};
  Diagnostics diagnostics;
  Reporter reporter{diagnostics};
  ProgramLines lines;
};

TEST(ProgramLines, reads_one_block_a_line_and_knows_where_it_stands) {
  LinesOfText text("G1 X1\n/G1 X2\nX3\n", {.block_delete = true, .sub_folders = {}});
  EXPECT_EQ(text.lines.read(), ProgramLines::Read::block);
  EXPECT_EQ(text.lines.at().line, 1U);
  EXPECT_EQ(text.lines.after().line, 2U);
  EXPECT_EQ(text.lines.block().words.size(), 2U);
  EXPECT_EQ(text.lines.read(), ProgramLines::Read::skipped);
  EXPECT_EQ(text.lines.read(), ProgramLines::Read::block);
  EXPECT_EQ(text.lines.block().line, 3U);
  EXPECT_EQ(text.lines.read(), ProgramLines::Read::end);
}

TEST(ProgramLines, give_the_same_block_when_a_line_comes_again) {
  LinesOfText text("G1 X1\nG1 X2\n");
  EXPECT_EQ(text.lines.read(), ProgramLines::Read::block);
  const ReaderPosition first = text.lines.at();
  for (int pass = 0; pass < 3; ++pass) {
    text.lines.seek(first);
    EXPECT_EQ(text.lines.read(), ProgramLines::Read::block);
    EXPECT_EQ(text.lines.block().line, 1U);
    EXPECT_EQ(text.lines.block().text, "G1 X1");
    EXPECT_EQ(text.lines.after().line, 2U);
  }
}

TEST(ProgramLines, report_a_line_that_is_no_g_code_once) {
  LinesOfText text("G1 X1\nG1 X#\n");
  EXPECT_EQ(text.lines.read(), ProgramLines::Read::block);
  const ReaderPosition second = text.lines.after();
  for (int pass = 0; pass < 3; ++pass) {
    text.lines.seek(second);
    EXPECT_EQ(text.lines.read(), ProgramLines::Read::skipped);
  }
  EXPECT_EQ(text.diagnostics.all().size(), 1U);
  EXPECT_EQ(text.reporter.errors(), 3U);
}

TEST(ProgramLines, find_a_sub_behind_the_line_at_hand_and_stay_there) {
  LinesOfText text("o100 call\nX1\no100 sub\nX2\no100 endsub\nM2\n");
  EXPECT_EQ(text.lines.read(), ProgramLines::Read::block);
  const Symbol label = text.symbols.intern("100");
  ProgramLines::File* const file = text.lines.find_sub(label);
  ASSERT_EQ(file, &text.lines.file());
  EXPECT_EQ(file->subs.at(label.id).at.line, 3U);
  EXPECT_EQ(text.lines.at().line, 1U);
  EXPECT_EQ(text.lines.block().text, "o100 call");
  EXPECT_EQ(text.lines.after().line, 2U);
  EXPECT_EQ(text.lines.find_sub(text.symbols.intern("101")), nullptr);
}

TEST(ProgramLines, pass_over_everything_but_o_words) {
  LinesOfText text("X1 (o1 if)\nG99999 X[\n o2 endif\n");
  Symbol label;
  ASSERT_TRUE(text.lines.read_control(label));
  EXPECT_EQ(text.lines.at().line, 3U);
  EXPECT_EQ(label_text(text.symbols, label), "2");
  EXPECT_FALSE(text.lines.read_control(label));
  EXPECT_TRUE(text.diagnostics.all().empty());
}

TEST(ProgramLines, lack_the_closing_percent_only_if_one_has_opened_them) {
  LinesOfText text("%\nG1 X1\n");
  EXPECT_FALSE(text.lines.lacks_closing_percent({}));
  EXPECT_EQ(text.lines.read(), ProgramLines::Read::block);
  EXPECT_FALSE(text.lines.percent_signs().closes());
  EXPECT_TRUE(text.lines.lacks_closing_percent(text.lines.after()));
}

TEST(RunawayGuard, stop_loops_in_which_the_machine_does_nothing) {
  using Reached = RunawayGuard::Reached;
  RunawayGuard bounds({.idle_passes = 2, .repeated_steps = 100});
  EXPECT_EQ(bounds.count_pass(), Reached::nothing);
  EXPECT_EQ(bounds.count_pass(), Reached::nothing);
  EXPECT_EQ(bounds.count_call(), Reached::nothing);  // calls count for themselves
  EXPECT_EQ(bounds.count_pass(), Reached::idle);
  bounds.count_operation(false);
  EXPECT_EQ(bounds.count_pass(), Reached::idle);
  bounds.count_operation(true);
  EXPECT_EQ(bounds.count_pass(), Reached::nothing);
}

TEST(RunawayGuard, stop_a_construct_that_comes_to_too_many_steps) {
  using Reached = RunawayGuard::Reached;
  RunawayGuard bounds({.idle_passes = 100, .repeated_steps = 3});
  EXPECT_EQ(bounds.count_pass(), Reached::nothing);
  EXPECT_EQ(bounds.count_call(), Reached::nothing);
  bounds.count_operation(true);
  EXPECT_TRUE(bounds.allows_more_operations());
  EXPECT_EQ(bounds.count_pass(), Reached::steps);
  EXPECT_FALSE(bounds.allows_more_operations());
  bounds.begin();
  EXPECT_EQ(bounds.count_pass(), Reached::nothing);
}

TEST(RunawayGuard, let_the_main_program_run_as_often_as_is_allowed) {
  RunawayGuard bounds({.idle_passes = 1, .repeated_steps = 3, .main_passes = 3});
  EXPECT_TRUE(bounds.count_main_pass());
  EXPECT_TRUE(bounds.count_restart());
  EXPECT_TRUE(bounds.count_main_pass());
  EXPECT_FALSE(bounds.count_restart());
  EXPECT_FALSE(bounds.count_main_pass());
}

TEST(RunawayGuard, allow_a_thousand_calls_that_lead_nowhere) {
  RunawayGuard bounds({});
  for (int call = 1; call < 1000; ++call) EXPECT_FALSE(bounds.is_last_unknown_call()) << call;
  EXPECT_TRUE(bounds.is_last_unknown_call());
}

TEST(UnreadableLabels, are_those_that_could_not_be_read) {
  SymbolTable symbols;
  UnreadableLabels labels;
  labels.add(symbols.intern("7"));
  EXPECT_TRUE(labels.has(symbols.intern("7")));
  EXPECT_FALSE(labels.has(symbols.intern("8")));
  labels.add_all();
  EXPECT_TRUE(labels.has(symbols.intern("8")));
}

TEST(PercentSigns, open_a_program_before_its_content_and_close_it_after) {
  PercentSigns signs;
  EXPECT_FALSE(signs.closes());
  EXPECT_TRUE(signs.opened());
  signs.note_content();
  EXPECT_TRUE(signs.closes());
}

TEST(PercentSigns, close_a_program_that_none_has_opened) {
  PercentSigns signs;
  signs.note_content();
  EXPECT_TRUE(signs.closes());
  EXPECT_FALSE(signs.opened());
}

}  // namespace
}  // namespace passo
