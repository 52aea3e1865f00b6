// The built-in vectors, and the first output that is wrong.
#include "passo/grading/board_case.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "kit/scratch_folder.hpp"
#include <gmock/gmock.h>

#include "passo/emulator/hex_file.hpp"

namespace passo {
namespace {

using testing::HasSubstr;

constexpr const char* vector_text =
    "# A comment.\n0 in direction.x 1\n1000 in clock.x 1\n1000 out windings.x 1001 within 60\n1500 in clock.x 0\n"
    "2000 in relay 1\n2000 out relay 1 within 60.5\n3000 end\n";

BoardCase one_case() {
  const auto read = read_board_case("one", vector_text);
  EXPECT_TRUE(read);
  BoardCase asked = *read;
  asked.outputs = {"windings.x", "windings.y", "relay"};
  return asked;
}

TEST(BoardCases, are_read_with_times_in_microseconds) {
  const BoardCase asked = one_case();
  ASSERT_EQ(asked.lines.size(), 4U);
  EXPECT_EQ(asked.lines[3].line, "relay");
  EXPECT_EQ(asked.lines[3].at, 2'000'000);
  ASSERT_EQ(asked.due.size(), 2U);
  EXPECT_EQ(asked.due[1].within, 60'500);
  EXPECT_EQ(asked.end, 3'000'000);
  EXPECT_EQ(read_board_case("odd", "0 in clock.x 1\nsoon in clock.x 0\n").error(),
            "odd, line 2: expected TIME in LINE LEVEL, TIME out OUTPUT VALUE within SPAN, TIME end or drive NAME, "
            "found 'soon in clock.x 0'");
  EXPECT_EQ(read_board_case("endless", "0 in clock.x 1\n").error(), "endless: has no end");
}

TEST(BoardCases, are_all_vectors_that_suit_the_board) {
  const auto names_of = [](const std::string& board) {
    std::vector<std::string> names;
    for (const BoardCase& one : board_cases(board)) names.push_back(one.name);
    return names;
  };
  EXPECT_THAT(names_of("first_board"), testing::IsSupersetOf({"steps", "axes", "direction", "first_board/held",
                                                              "first_board/waiting", "first_board/emergency"}));
  EXPECT_THAT(names_of("pic_two_on"), testing::IsSupersetOf({"steps", "jog", "modes", "reset"}));
  EXPECT_THAT(names_of("pic_wave"), testing::ElementsAre("wave"));
  EXPECT_THAT(names_of("pic_half_step"), testing::ElementsAre("half_step"));
  // Each variant of the first board has vectors of its own, and none of the others.
  for (const std::string& board : graded_boards()) {
    for (const std::string& name : names_of(board)) {
      EXPECT_TRUE(name.find('/') == std::string::npos || name.starts_with(board + "/")) << board << ": " << name;
    }
  }
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(PASSO_SOURCE_DIR "/tests/follower/vectors")) {
    if (entry.path().extension() == ".txt") ++files;
  }
  EXPECT_EQ(names_of("pic_two_on").size() + names_of("pic_wave").size() + names_of("pic_half_step").size(), files);
  for (const std::string& board : graded_boards()) {
    for (const BoardCase& one : board_cases(board)) EXPECT_LE(one.end, 5'000'000'000) << one.name;
  }
}

// 0.1 s after the reset of the first board somebody has pressed `*`; the pulses are five times as slow.
TEST(BoardCases, on_the_first_board_come_after_the_key_for_automatic_mode) {
  const std::vector<BoardCase> cases = board_cases("first_board");
  const auto steps = std::ranges::find(cases, "steps", &BoardCase::name);
  ASSERT_NE(steps, cases.end());
  EXPECT_EQ(steps->lines.front().line, "key.*");
  const auto clock = std::ranges::find(steps->lines, "clock.x", &LineChange::line);
  EXPECT_EQ(clock->at, 100'000'000 + 5 * 1'000'000);
}

TEST(OutputFault, is_the_first_in_time_of_all_outputs) {
  const std::vector<OutputChange> right = {{1'030'000, "windings.x", "1001"}, {2'000'000, "relay", "1"}};
  EXPECT_EQ(find_output_fault(one_case(), right).output, "");
  EXPECT_EQ(find_output_fault(one_case(), {}).words,
            "windings.x, change 1: expected 1001 at 1 ms, at most 0.06 ms later, found no change");
  const std::vector<OutputChange> late = {{1'090'000, "windings.x", "1001"}, {2'000'000, "relay", "1"}};
  EXPECT_THAT(find_output_fault(one_case(), late).words, HasSubstr("found 1001 at 1.09 ms"));
  const std::vector<OutputChange> wrong = {{1'030'000, "windings.x", "0110"}, {900'000, "relay", "1"}};
  const OutputFault fault = find_output_fault(one_case(), wrong);
  EXPECT_EQ(fault.output, "relay");
  EXPECT_EQ(fault.at, 900'000);
  const std::vector<OutputChange> more = {
      {1'030'000, "windings.x", "1001"}, {1'500'000, "windings.y", "0110"}, {2'000'000, "relay", "1"}};
  EXPECT_EQ(find_output_fault(one_case(), more).words,
            "windings.y, change 1: expected no change, found 0110 at 1.5 ms");
  // Windings that are switched one after the other.
  BoardCase slowly = one_case();
  slowly.settling = 10'000;
  const std::vector<OutputChange> stepwise = {{1'020'000, "windings.x", "1000"},
                                              {1'025'000, "windings.x", "0000"},
                                              {1'026'000, "windings.x", "0001"},
                                              {1'030'000, "windings.x", "1001"},
                                              {2'000'000, "relay", "1"}};
  EXPECT_EQ(find_output_fault(slowly, stepwise).output, "");
  EXPECT_EQ(find_output_fault(one_case(), stepwise).found, "1000");
  // What is not looked at may do anything.
  const std::vector<OutputChange> other = {
      {10, "led.0", "1"}, {1'030'000, "windings.x", "1001"}, {2'000'000, "relay", "1"}};
  EXPECT_EQ(find_output_fault(one_case(), other).output, "");
}

TEST(HexFile, has_whole_records_up_to_its_last_one) {
  const std::filesystem::path file = test::scratch_folder() / "test.hex";
  const auto fault_of = [&](const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
    return find_hex_fault(file);
  };
  const std::string record = ":040000008316FF0163\r\n";
  const std::string last = ":00000001FF\n";
  EXPECT_EQ(fault_of(record + last), "");
  EXPECT_EQ(fault_of(record + "\n" + last + "anything"), "");
  EXPECT_EQ(fault_of(record + ":040000008316FF0164\n" + last), "line 2: its checksum is wrong");
  EXPECT_EQ(fault_of(record + ":0400000083"), "line 2: its length is not the one that it gives");
  EXPECT_EQ(fault_of(record + ":0400000"), "line 2: it is no whole record");
  EXPECT_EQ(fault_of("hello\n"), "line 1: it does not begin with ':'");
  EXPECT_EQ(fault_of(":04000000831GFF0163\n"), "line 1: it has characters that are no hexadecimal digits");
  EXPECT_EQ(fault_of(record), "it ends after line 1 without a last record (:00000001FF)");
  EXPECT_EQ(fault_of(""), "it ends after line 0 without a last record (:00000001FF)");
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace passo
