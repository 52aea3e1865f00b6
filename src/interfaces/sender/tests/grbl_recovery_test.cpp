// How a GrblMachineSession comes back to its board: devices that return, a sender that was lent.
#include "kit/example_machine.hpp"
#include "kit/grbl_session_run.hpp"
#include <gmock/gmock.h>

#include "passo/sender/firmware_settings.hpp"

namespace passo::test {
namespace {

using testing::HasSubstr;

constexpr const char* line_of_ten = "G21 G90\nG1 X10 F1200\nG1 Y10\nM2\n";

struct GrblRecoveries : testing::Test {
  explicit GrblRecoveries() : run(example_machine("router")) {}
  GrblSessionRun run;
};

TEST_F(GrblRecoveries, open_a_device_that_was_unplugged_and_returns) {
  run.port.is_usb = true;
  ASSERT_TRUE(run.go_online());
  const auto ticket = run.ask(grbl_start(line_of_ten));
  ASSERT_TRUE(ticket);
  ASSERT_TRUE(run.play([&] { return run.grbl.place()[Axis::x] > 3; }));
  run.port.unplugged = true;
  const Seconds pulled = run.session.now();
  ASSERT_TRUE(run.play_until(MachineState::fault));
  EXPECT_LT(run.session.now() - pulled, Seconds(2));
  EXPECT_EQ(run.answer_to(*ticket)->outcome, Outcome::failed);
  ASSERT_TRUE(run.play_for(Seconds(20))) << "it is looked for without end";
  EXPECT_EQ(run.session.state(), MachineState::fault);
  // It is opened without a request. Nothing of the program is sent again, and its place is lost.
  const std::size_t sent = run.port.sent.size();
  run.grbl.restart();
  run.port.unplugged = false;
  ASSERT_TRUE(run.play_until(MachineState::idle, Seconds(15)));
  EXPECT_THAT(run.port.sent.substr(sent), testing::Not(HasSubstr("X10")));
  EXPECT_TRUE(run.session.lost_place());
  EXPECT_FALSE(run.ask(grbl_start(line_of_ten)));
  ASSERT_TRUE(run.play_for(Seconds(5)));
  EXPECT_EQ(run.grbl.speed(), 0);
}

TEST_F(GrblRecoveries, lend_their_sender_to_a_reader_of_the_settings) {
  EXPECT_EQ(run.session.lend_sender(), nullptr) << "not before the board has answered";
  ASSERT_TRUE(run.go_online());
  EXPECT_FALSE(run.session.abilities().can(Ability::home));
  GrblSender* const sender = run.session.lend_sender();
  ASSERT_NE(sender, nullptr);
  EXPECT_EQ(run.session.lend_sender(), nullptr) << "to one at a time";
  FirmwareSettings settings(*sender);
  settings.write("$22", "1");
  ASSERT_TRUE(run.play([&] {
    settings.poll();
    return !settings.busy();
  }));
  EXPECT_FALSE(run.ask(grbl_start(line_of_ten))) << "nothing begins meanwhile";
  EXPECT_EQ(run.refusal->code(), RefusalCode::busy);
  const auto changes = settings.take_changes();
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes.front().trouble, "");
  EXPECT_TRUE(run.session.is_sender_lent());
  run.session.take_sender_back();
  EXPECT_TRUE(run.session.abilities().can(Ability::home)) << "the session knows the new setting";
  const auto ticket = run.ask(grbl_start(line_of_ten));
  ASSERT_TRUE(ticket);
  EXPECT_EQ(run.session.lend_sender(), nullptr) << "not while a program runs";
  ASSERT_TRUE(run.play([&] { return run.answer_to(*ticket).has_value(); }));
  EXPECT_EQ(run.answer_to(*ticket)->outcome, Outcome::done);
}

TEST_F(GrblRecoveries, have_their_sender_back_after_a_restart_of_the_board) {
  ASSERT_TRUE(run.go_online());
  GrblSender* const sender = run.session.lend_sender();
  ASSERT_NE(sender, nullptr);
  run.grbl.restart();
  ASSERT_TRUE(run.play([&] { return !run.session.is_sender_lent(); }, Seconds(5)));
  run.session.take_sender_back();
}

// The chip takes no byte while it writes its EEPROM: at the rate of a line, what follows is lost.
TEST_F(GrblRecoveries, store_offsets_at_the_rate_of_a_line) {
  run.grbl.bytes_per_second = 11520;
  ASSERT_TRUE(run.go_online());
  SavedParameters wanted = run.session.offsets();
  wanted[5221] = 7;  // X of G54
  run.session.store_offsets(wanted);
  ASSERT_TRUE(run.play([&] { return !run.session.works(); }, Seconds(10)));
  EXPECT_EQ(run.session.state(), MachineState::idle) << run.session.trouble_words();
  EXPECT_EQ(run.grbl.lost_bytes(), 0U);
  EXPECT_NEAR(run.session.board().offsets.at("G54")[Axis::x], 7, 1e-9);
}

}  // namespace
}  // namespace passo::test
