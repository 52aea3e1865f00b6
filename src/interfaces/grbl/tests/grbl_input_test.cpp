// How the bytes of a sender become lines and real-time commands.
#include "passo/grbl/grbl_input.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace passo {
namespace {

struct Heard {
  std::vector<int> commands;
  std::vector<std::string> lines;
};

Heard hear(std::string_view bytes) {
  GrblInput input;
  Heard heard;
  for (const char c : bytes) {
    input.receive(std::string_view(&c, 1), [&](std::uint8_t byte) { heard.commands.push_back(byte); });
  }
  while (const auto line = input.pop_line()) heard.lines.push_back(line->text + (line->too_long ? "..." : ""));
  return heard;
}

TEST(GrblInput, real_time_commands_act_in_the_middle_of_a_line) {
  const Heard heard = hear("G1?X!1\x18~0\n");
  EXPECT_EQ(heard.commands, (std::vector<int>{'?', '!', 0x18, '~'}));
  EXPECT_EQ(heard.lines, (std::vector<std::string>{"G1X10"}));
}

TEST(GrblInput, a_high_command_may_come_as_one_byte_or_in_utf_8) {
  EXPECT_EQ(hear("\x85").commands, (std::vector<int>{0x85}));
  EXPECT_EQ(hear("\xC2\x85").commands, (std::vector<int>{0x85}));
  EXPECT_EQ(hear("\xC2\x85\x90").commands, (std::vector<int>{0x85, 0x90}));
}

TEST(GrblInput, a_letter_of_utf_8_text_is_no_command) {
  // "Ä" is C3 84, and 84 alone is the safety door. "“" is E2 80 9C, and 9C alone slows the spindle.
  EXPECT_TRUE(hear("(\xC3\x84 \xE2\x80\x9C)\n").commands.empty());
  // A cut character does not swallow the command after the next plain byte.
  EXPECT_EQ(hear("\xC3\nG0\x85").commands, (std::vector<int>{0x85}));
}

TEST(GrblInput, a_line_ends_once_with_any_line_end) {
  EXPECT_EQ(hear("G0\r\nG1\nG2\r\n\n").lines, (std::vector<std::string>{"G0", "G1", "G2", ""}));
  EXPECT_EQ(hear("G0\rG1\r").lines, (std::vector<std::string>{"G0", "G1"}));
}

TEST(GrblInput, blanks_comments_and_slashes_are_taken_out) {
  EXPECT_EQ(hear("/g1 x1 (to; the\tright) y2 ; end (of) it\n").lines, (std::vector<std::string>{"G1X1Y2"}));
}

TEST(GrblInput, a_long_line_is_marked_and_the_next_one_is_whole) {
  std::string bytes;
  for (int i = 0; i < 300; ++i) bytes.push_back('X');
  bytes.append("\nG0\n");
  const Heard heard = hear(bytes);
  ASSERT_EQ(heard.lines.size(), 2U);
  EXPECT_EQ(heard.lines[0].size(), GrblInput::longest_stripped + 3);
  EXPECT_TRUE(heard.lines[0].ends_with("X..."));
  EXPECT_EQ(heard.lines[1], "G0");
}

TEST(GrblInput, room_is_told_truly_and_no_byte_is_dropped) {
  GrblInput input;
  const auto ignore = [](std::uint8_t) {};
  EXPECT_EQ(input.free(), GrblInput::told_size);
  input.receive("G1X10\n", ignore);
  EXPECT_EQ(input.free(), GrblInput::told_size - 6);
  std::size_t lines = 1;
  for (; input.wants_more(); ++lines) input.receive("G1X10\n", ignore);
  EXPECT_EQ(input.free(), 0U);
  for (; lines > 0; --lines) EXPECT_EQ(input.pop_line()->text, "G1X10");
  EXPECT_FALSE(input.pop_line());
  EXPECT_EQ(input.free(), GrblInput::told_size);
}

}  // namespace
}  // namespace passo
