#include "passo/session/position_record.hpp"

#include <string>

#include "kit/example_machine.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

class PlaceRecords : public testing::Test {
 protected:
  PlaceRecords() {
    record_ = {.machine = place_fingerprint(machine_),
               .trust = Trust::homed,
               .zero_counts = {1000, -2'000'000'000, 7},
               .numbers = {.session_before = 11, .executed_before = 65'000, .greeting = 200, .session = 300}};
    status_.positions[0] = 1000 + 640;
    status_.positions[1] = -2'000'000'000;
    status_.positions[2] = 7 - 1280;
  }
  Result<KnownPosition, PositionDoubt> place() const { return place_of(record_, machine_, status_); }
  PositionDoubt doubt() const {
    const auto found = place();
    EXPECT_FALSE(found);
    return found ? PositionDoubt::no_record : found.error();
  }

  MachineDescription machine_ = test::example_machine("router");
  PositionRecord record_;
  BoardStatus status_{.session = 300, .executed = 4, .state = board_trusted, .motors = 3};
};

TEST_F(PlaceRecords, are_read_as_they_were_written_and_not_when_they_are_torn) {
  for (const bool is_lost : {false, true}) {
    record_.is_lost = is_lost;
    const std::string text = text_of(record_);
    EXPECT_EQ(read_place_record(text), record_);
    for (std::size_t size = 0; size < text.size(); ++size) EXPECT_FALSE(read_place_record(text.substr(0, size)));
    for (std::size_t at = 0; at < text.size(); ++at) {
      std::string other = text;
      other[at] = other[at] == '7' ? '8' : '7';
      EXPECT_FALSE(read_place_record(other)) << at;
    }
  }
}

TEST_F(PlaceRecords, tell_the_place_by_what_the_board_has_counted_since) {
  const auto found = place();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->trust, Trust::homed);
  const double scale = machine_.axes[0].steps_per_unit;
  EXPECT_EQ(found->place[Axis::x], (machine_.axes[0].inverted ? -640 : 640) / scale);
  EXPECT_EQ(found->place[Axis::y], 0);
}

TEST_F(PlaceRecords, know_their_board_at_every_stage_of_the_next_hello) {
  status_.session = 11;
  status_.executed = 65'000;
  EXPECT_TRUE(place()) << "no hello came through";
  status_.session = 0;
  status_.executed = 200;
  EXPECT_TRUE(place()) << "but no session";
}

TEST_F(PlaceRecords, do_not_trust_a_board_that_was_reset) {
  status_ = {.session = 0, .executed = 0, .state = board_trusted, .motors = 0};
  EXPECT_EQ(doubt(), PositionDoubt::board_reset);
  record_.numbers.session_before = record_.numbers.executed_before = 0;
  EXPECT_EQ(doubt(), PositionDoubt::board_reset) << "it looks as it did before its first hello";
}

TEST_F(PlaceRecords, do_not_call_a_machine_that_was_moved_by_the_keypad_a_board_of_another_program) {
  status_ = {.session = 0, .executed = 7, .state = board_trusted, .motors = 3};
  EXPECT_EQ(doubt(), PositionDoubt::session_ended);
}

TEST_F(PlaceRecords, do_not_trust_a_board_of_another_host_or_machine_or_one_that_was_stopped_at_once) {
  status_.session = 301;
  EXPECT_EQ(doubt(), PositionDoubt::other_session);
  status_.session = 300;
  status_.state = 0;
  EXPECT_EQ(doubt(), PositionDoubt::stopped_at_once);
  status_.inputs = drivers_timed_out;
  EXPECT_EQ(doubt(), PositionDoubt::drivers_off) << "nothing has stopped its motors";
  status_.state = board_trusted;
  status_.inputs = 0;
  machine_.axes[1].steps_per_unit *= 2;
  EXPECT_EQ(doubt(), PositionDoubt::other_machine);
  EXPECT_FALSE(place_of(std::nullopt, machine_, status_));
}

// Nobody knows where machine zero is, and the work's zero stays where it was.
TEST_F(PlaceRecords, go_on_counting_where_nobody_trusts_the_place) {
  const Point known = place()->place;
  record_.trust = Trust::unknown;
  EXPECT_FALSE(place());
  EXPECT_EQ(counted_place(record_, machine_, status_), known);
  EXPECT_EQ(read_place_record(text_of(record_)), record_);
  status_.state = 0;
  EXPECT_EQ(counted_place(record_, machine_, status_), known) << "stopped at once";
  status_.session = 301;
  EXPECT_EQ(counted_place(record_, machine_, status_), std::nullopt);
}

}  // namespace
}  // namespace passo
