// Lines that come again. Keeping their blocks changes nothing but the speed.
#include "../kept_blocks.hpp"

#include <filesystem>
#include <fstream>

#include "interpreted.hpp"
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

// G1 alone is a feed to where the tool is.
constexpr const char* head = "G21 G90 F100 G1\n";

// The X of the ends of the feeds after the head.
std::vector<double> ends(const Interpreted& result) {
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  std::vector<double> ends;
  for (const auto& feed : result.all<operation::StraightFeed>()) ends.push_back(feed.end[Axis::x]);
  ends.erase(ends.begin());
  return ends;
}

TEST(KeptBlocks, a_line_is_known_until_another_takes_its_place) {
  KeptBlocks kept;
  const ReaderPosition at{.offset = 100, .line = 7};
  const ReaderPosition other{.offset = 9000, .line = 7 + KeptBlocks::places};
  EXPECT_EQ(kept.find(0, at), nullptr);
  kept.make_room(0, at, {.offset = 110, .line = 8}, "X1");
  ASSERT_NE(kept.find(0, at), nullptr);
  EXPECT_EQ(kept.find(0, at)->text, "X1");
  EXPECT_EQ(kept.find(1, at), nullptr);
  EXPECT_EQ(kept.find(0, other), nullptr);
  kept.make_room(0, other, {}, "X2");
  EXPECT_EQ(kept.find(0, at), nullptr);
  KeptBlocks::drop(*kept.find(0, other));
  EXPECT_EQ(kept.find(0, other), nullptr);
}

TEST(KeptBlocks, a_body_of_any_length_means_the_same_in_each_pass) {
  for (const std::size_t body : {KeptBlocks::places - 2, KeptBlocks::places + 1, 5 * KeptBlocks::places / 2}) {
    std::string program = std::string(head) + "#1=0\no1 repeat [4]\n";
    std::vector<double> expected;
    for (std::size_t i = 0; i < body; ++i) program += fmt::format("X[#1 + {}]\n", i);
    for (std::size_t i = 0; i < 4 * body; ++i) expected.push_back(static_cast<double>(i));
    program += fmt::format("#1=[#1 + {}]\no1 endrepeat\nM2\n", body);
    EXPECT_EQ(ends(interpret_text(program)), expected) << body;
  }
}

TEST(KeptBlocks, lines_too_long_to_be_kept_mean_the_same_in_each_pass) {
  const std::string comment = "(" + std::string(KeptBlocks::longest_text, '.') + ")";
  const std::string program = std::string(head) + "o1 repeat [3]\n#1=[#1 + 1] " + comment + "\nX#1 " + comment +
                              "\no2 if [#1 EQ 2] " + comment + "\nX0\no2 endif\no1 endrepeat\nM2\n";
  EXPECT_EQ(ends(interpret_text(program)), (std::vector<double>{1, 2, 0, 3}));
}

TEST(KeptBlocks, branches_and_computed_labels_are_asked_in_each_pass) {
  const std::string program =
      std::string(head) +
      "o11 sub\nX[#1 * 10]\no11 endsub\no12 sub\nX[#1 * 100]\no12 endsub\n#1=0\no1 while [#1 LT 4]\n"
      "#1=[#1 + 1]\no2 if [#1 EQ 3]\nX-1\no2 else\no[10 + #1] call [#1]\no1 continue\no2 endif\no1 break\n"
      "o1 endwhile\nM2\n";
  EXPECT_EQ(ends(interpret_text(program)), (std::vector<double>{10, 200, -1}));
}

TEST(KeptBlocks, what_goes_wrong_in_a_later_pass_is_shown_in_its_line) {
  const Interpreted result =
      interpret_text("#1=3\no1 repeat [4]\n#2=[6 / #1] (the line)\n#1=[#1 - 1]\no1 endrepeat\nM2\n");
  ASSERT_EQ(result.diagnostics.errors(), 1U) << result.rendered();
  const Diagnostic& error = result.diagnostics.all().front();
  EXPECT_EQ(error.code, "gcode.division-by-zero");
  EXPECT_EQ(error.text, "#2=[6 / #1] (the line)");
  EXPECT_EQ(error.place, (SourceLocation{3, 5, 6}));
}

TEST(KeptBlocks, a_construct_left_open_in_a_sub_is_shown_in_its_line_each_time) {
  const Interpreted result =
      interpret_text("o1 sub\no2 if [1]\nG1 F1 X1\no1 endsub\no1 call\nX2\no1 call\nX2\no1 call\nX2\nM2\n");
  ASSERT_EQ(result.diagnostics.errors(), 1U) << result.rendered();
  EXPECT_EQ(result.diagnostics.all().front().text, "o2 if [1]");
  EXPECT_EQ(result.all<operation::StraightFeed>().size(), 6U);
}

TEST(KeptBlocks, lines_of_two_files_are_told_apart) {
  // The lines of the sub have the same places in KeptBlocks as the lines around its call.
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "passo_kept_blocks";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "twin.ngc") << "o<twin> sub\nX[#1 * 2]\no<twin> endsub\n";
  std::string program = head;
  for (int i = 0; i < 57; ++i) program += "\n";
  program += "#1=0\no1 repeat [3]\n#1=[#1 + 1]\nX#1\no<twin> call [#1 * 10]\no1 endrepeat\nM2\n";
  InterpreterOptions options;
  options.sub_folders = {folder.string()};
  EXPECT_EQ(ends(interpret_text(program, options)), (std::vector<double>{1, 20, 2, 40, 3, 60}));
  std::filesystem::remove_all(folder);
}

TEST(KeptBlocks, deleted_lines_stay_deleted) {
  InterpreterOptions options;
  options.block_delete = true;
  const std::string program = std::string(head) + "o1 repeat [3]\n#1=[#1 + 1]\n/ X0\nX#1\no1 endrepeat\nM2\n";
  EXPECT_EQ(ends(interpret_text(program, options)), (std::vector<double>{1, 2, 3}));
}

// The reader's buffer can hold the sub or the calls, but not both.
TEST(KeptBlocks, a_sub_may_be_far_from_its_calls) {
  const std::string path = (std::filesystem::temp_directory_path() / "passo_far_sub.ngc").string();
  std::string program = std::string(head) + "o1 sub\n#<a>=[#1 + 1]\nX#<a>\no1 endsub\n";
  for (int i = 0; i < 20'000; ++i) program += "(a line that is only there to be long)\n";
  program += "o2 repeat [3]\n#5=[#5 + 1]\no1 call [#5]\nX0\no2 endrepeat\nM2\n";
  std::ofstream(path, std::ios::binary) << program;
  Interpreted result;
  interpret(std::move(*ProgramReader::open(path)), {}, result);
  std::filesystem::remove(path);
  EXPECT_EQ(ends(result), (std::vector<double>{2, 0, 3, 0, 4, 0}));
}

}  // namespace
}  // namespace passo
