// A journal of a real job, torn at each byte: the place at which the board rests is found in what is left of the
// journal, the very same place, or the journal is refused.
#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kit/driven.hpp"
#include "kit/example_machine.hpp"
#include "kit/in_full.hpp"
#include "kit/journaled_host.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

constexpr const char* torn_job = "G21 G90 G64 P.02 F3000 M3 S1000\nG4 P.1\nG2 X6 Y0 I3 J0\nG3 X9 I1.5\nG1 X4 Y3\nM2\n";

struct LeftBehind {
  std::string journal;
  BoardStatus status;
  PathPosition place;
};

// What a host leaves that dies at this moment. Empty: before the journal knows a rest.
std::optional<LeftBehind> host_dies_at(const MachineDescription& machine, std::uint64_t moment) {
  VirtualMachine board(3, machine.board.clock, machine.board.highest_event_rate,
                       static_cast<std::size_t>(machine.board.held_items));
  VirtualLine line(board, machine.board.clock, {});
  test::JournaledHost host(machine, torn_job);
  std::uint64_t moments = 0;
  EXPECT_FALSE(host.live(line, moment, test::HostEnd::behind_frame, moments));
  BoardSession asking(line, test::real_line_care);
  const auto status = ask_status_at_rest(asking, Seconds(5));
  const auto journal = Journal::read(host.store.bytes);
  const auto place = status && journal ? journal->place_of(*status) : std::nullopt;
  if (!place) return {};
  return LeftBehind{.journal = host.store.bytes, .status = *status, .place = *place};
}

// Counts in how many of the torn journals the place was found.
void look_into(const std::string& torn, const LeftBehind& left, int& found, int& refused) {
  const auto journal = Journal::read(torn);
  const auto place = journal ? journal->place_of(left.status) : std::nullopt;
  ++(place ? found : refused);
  if (place) {
    ASSERT_EQ(*place, left.place);
  }
}

TEST(TornJournal, tells_the_right_place_or_none_wherever_it_ends) {
  const MachineDescription machine = test::example_machine("router");
  int found = 0;
  int refused = 0;
  // At each byte of one journal; in full, of three, or at one byte of so many.
  const std::vector<std::uint64_t> moments =
      test::in_full() == 0 ? std::vector<std::uint64_t>{300} : std::vector<std::uint64_t>{40, 160, 300};
  const std::size_t stride = std::max<std::size_t>(test::in_full(), 1);
  for (const std::uint64_t moment : moments) {
    const auto left = host_dies_at(machine, moment);
    ASSERT_TRUE(left) << moment;
    for (std::size_t size = 0; size <= left->journal.size() && !HasFatalFailure(); size += stride) {
      look_into(left->journal.substr(0, size), *left, found, refused);
    }
  }
  std::printf("%d times found, %d times refused\n", found, refused);
  EXPECT_GT(found, 0);
  EXPECT_GT(refused, 0);
}

// A line was being overwritten: its first bytes are new, and the rest is still that of a line long ago, or blank.
TEST(TornJournal, tells_the_right_place_or_none_where_a_line_is_half_written) {
  const MachineDescription machine = test::example_machine("router");
  const auto left = host_dies_at(machine, 300);
  ASSERT_TRUE(left);
  const std::string& whole = left->journal;
  int found = 0;
  int refused = 0;
  const std::size_t stride = test::in_full() == 0 ? 11 : test::in_full();
  for (std::size_t at = 0; at < whole.size() && !HasFatalFailure(); at += stride) {
    if (whole[at] == '\n') continue;
    std::string torn = whole;
    const std::size_t end = std::min(whole.find('\n', at), whole.size());
    // The rest of the line is blank, or one byte of it is another.
    std::fill(torn.begin() + static_cast<std::ptrdiff_t>(at), torn.begin() + static_cast<std::ptrdiff_t>(end), ' ');
    look_into(torn, *left, found, refused);
    torn = whole;
    torn[at] = torn[at] == '0' ? '1' : '0';
    look_into(torn, *left, found, refused);
  }
  std::printf("%d times found, %d times refused\n", found, refused);
  EXPECT_GT(found, 0);
  EXPECT_GT(refused, 0);
}

// Each reason has its words and its code.
TEST(TornJournal, is_refused_in_words) {
  const MachineDescription machine = test::example_machine("router");
  const auto left = host_dies_at(machine, 300);
  ASSERT_TRUE(left);
  const auto reader = ProgramReader::from_text("t", torn_job);
  for (std::size_t size = 0; size < left->journal.size(); size += 997) {
    const auto journal = Journal::read(left->journal.substr(0, size));
    if (!journal) continue;
    const auto point = resume_point_of(*journal, left->status, reader, machine, InterpreterOptions());
    if (point) continue;
    EXPECT_FALSE(message_of(point.error()).empty());
    EXPECT_TRUE(code_of(point.error()).starts_with("resume."));
  }
}

}  // namespace
}  // namespace passo
