// A session with a spindle that this computer controls: motion waits for its speed, a fault holds the program, and it
// is off where no program runs. Board, drive and motor are simulated in one virtual time.
#include "passo/drive/host_spindle.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "kit/random_point.hpp"
#include "kit/timed_vfd.hpp"
#include "pipeline/session_kit.hpp"
#include <gmock/gmock.h>

#include "passo/machine_file/spindle_bus_description.hpp"
#include "passo/spindle/spindle_controller.hpp"

namespace passo {
namespace {

using test::SessionRun;
using test::start_of;
using test::TimedVfd;
using testing::HasSubstr;

// The controller without a thread: its owner steps it.
class TimedSpindle final : public HostSpindle {
 public:
  TimedSpindle(Vfd& vfd, const SpindleBusDescription& bus, SpindleController::Clock clock)
      : controller_(vfd, bus, std::move(clock)) {}

  void order(const SpindleOrder& wanted) override { controller_.order(wanted); }
  HostSpindleStatus status() const override { return controller_.status(); }
  void step() { controller_.step(); }

 private:
  bool try_to_clear() override { return controller_.clear_fault(); }

  SpindleController controller_;
};

MachineDescription machine_with_drive() {
  MachineDescription machine = test::short_router();
  auto bus = std::make_shared<SpindleBusDescription>();
  *bus = {.drive = "h100", .device = "/dev/ttyUSB0", .highest_rpm = 24000, .reach = Seconds(5)};
  machine.spindle.modbus = std::move(bus);
  return machine;
}

class HostSpindleTest : public testing::Test {
 protected:
  HostSpindleTest() {
    clock = &run;
    run.make_ready();
    turn(Seconds(0.5));
  }

  void poll() {
    run.poll(Seconds(0.005));
    vfd.turn();
    spindle.step();
  }
  void turn(Seconds time) {
    for (const Seconds end = run.now() + time; run.now() < end;) poll();
  }
  template <class Condition>
  bool turn_until(Condition condition, Seconds within = Seconds(60)) {
    for (const Seconds end = run.now() + within; !condition() && run.now() < end;) poll();
    return condition();
  }
  bool turn_until(MachineState wanted) {
    return turn_until([&] { return run.state() == wanted; });
  }
  double x() const { return std::abs(static_cast<double>(run.board().counts().motors[0].position)); }

  const MachineDescription machine = machine_with_drive();
  // The run and the spindle need each other: the clock is the run's, as soon as there is one.
  SessionRun* clock = nullptr;
  TimedVfd vfd{[this] { return clock != nullptr ? clock->now() : Seconds(0); }};
  TimedSpindle spindle{vfd, *machine.spindle.modbus, [this] { return clock != nullptr ? clock->now() : Seconds(0); }};
  SessionRun run{machine, {.line = true, .spindle = &spindle}};
};

TEST_F(HostSpindleTest, motion_waits_for_the_speed_that_is_reached) {
  run.taken(start_of("G21 G90 M3 S18000\nG1 F1200 X10\nM2\n"));
  const Seconds begun = run.now();
  ASSERT_TRUE(turn_until([&] { return x() > 0; }));
  EXPECT_GE(vfd.speed, 0.95 * 18000);
  EXPECT_GE((run.now() - begun).value(), 1.9);
  EXPECT_LE((run.now() - begun).value(), 2.6);
  ASSERT_TRUE(turn_until([&] { return !run.session().busy(); }));
  EXPECT_EQ(run.state(), MachineState::idle);
  EXPECT_EQ(vfd.direction, 0);
}

TEST_F(HostSpindleTest, a_faster_spindle_is_waited_for_less_and_a_change_of_speed_again) {
  vfd.rpm_a_second = 90'000;
  run.taken(start_of("G21 G90 M3 S6000\nG1 F1200 X1\nS18000\nX2\nS9000\nX3\nM2\n"));
  std::vector<double> speeds;
  double last = 0;
  ASSERT_TRUE(turn_until([&] {
    const double at = x();
    const bool starts = at > last && run.session().status().executes.line != 0;
    if (starts) speeds.push_back(vfd.speed);
    last = at;
    return !run.session().busy();
  }));
  ASSERT_FALSE(speeds.empty());
  // In motion, always one of the three speeds.
  for (const double speed : speeds) {
    const bool is_ordered =
        std::abs(speed - 6000) <= 300 || std::abs(speed - 18000) <= 900 || std::abs(speed - 9000) <= 450;
    EXPECT_TRUE(is_ordered) << speed;
  }
}

TEST_F(HostSpindleTest, a_spindle_that_does_not_reach_its_speed_holds_the_program_before_it_moves) {
  vfd.top_rpm = 7200;
  run.taken(start_of("G21 G90 M3 S18000\nG1 F1200 X10\nM2\n"));
  ASSERT_TRUE(turn_until(MachineState::hold));
  EXPECT_EQ(x(), 0);
  EXPECT_EQ(run.session().status().trouble_sentence.code, "spindle.not-reached");
  turn(Seconds(3));
  EXPECT_EQ(vfd.direction, 0);
  EXPECT_EQ(x(), 0);
  // Its cause is gone.
  vfd.top_rpm = 24000;
  run.taken(request::Resume{});
  ASSERT_TRUE(turn_until([&] { return x() > 0; }));
  EXPECT_GE(vfd.speed, 0.95 * 18000);
  ASSERT_TRUE(turn_until([&] { return !run.session().busy(); }));
  EXPECT_TRUE(run.session().status().trouble_sentence.code.empty());
}

TEST_F(HostSpindleTest, a_fault_of_the_drive_holds_the_program_on_its_path_and_names_itself) {
  const Ticket ticket = run.taken(start_of("G21 G90 M3 S18000\nG1 F1200 X20\nX0\nM2\n"));
  ASSERT_TRUE(turn_until([&] { return x() > 0; }));
  turn(Seconds(0.2));
  vfd.fault = 3;
  ASSERT_TRUE(turn_until(MachineState::hold));
  EXPECT_EQ(run.session().status().trouble_sentence.text, "the spindle's drive reports fault 3: overcurrent");
  ASSERT_TRUE(turn_until([&] { return run.rests(); }));
  turn(Seconds(3));
  EXPECT_EQ(run.board().counts().outputs.switches, 0) << "the board's outputs are off, too";
  // The first resumption resets the drive, which is not ready yet.
  const auto refused = run.ask(request::Resume{});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message(), HasSubstr("the spindle is not ready: the spindle's drive reports fault 3"));
  EXPECT_EQ(refused.error().sentence().code, "machine.not-ready.spindle");
  const double held_at = x();
  turn(Seconds(2));
  EXPECT_EQ(vfd.fault, 0);
  run.taken(request::Resume{});
  ASSERT_TRUE(turn_until([&] { return x() != held_at; }));
  EXPECT_GE(vfd.speed, 0.95 * 18000);
  ASSERT_TRUE(turn_until([&] { return !run.session().busy(); }));
  EXPECT_EQ(run.outcome(ticket), Outcome::done);
  run.expect_at_place();
}

TEST_F(HostSpindleTest, a_silent_drive_holds_the_program_within_a_second_and_a_half) {
  run.taken(start_of("G21 G90 M3 S18000\nG1 F300 X20\nM2\n"));
  ASSERT_TRUE(turn_until([&] { return x() > 0; }));
  turn(Seconds(0.5));
  vfd.is_silent = true;
  const Seconds lost = run.now();
  ASSERT_TRUE(turn_until([&] { return run.rests(); }));
  EXPECT_LE((run.now() - lost).value(), 1.5);
  EXPECT_EQ(run.session().status().trouble_sentence.code, "spindle.no-answer");
  EXPECT_EQ(run.refusal_of(request::Resume{}), "machine.not-ready");
  turn(Seconds(1));
  vfd.is_silent = false;
  turn(Seconds(1));
  EXPECT_EQ(vfd.direction, 0) << "it is stopped as soon as it can be told";
  run.taken(request::Resume{});
  ASSERT_TRUE(turn_until([&] { return !run.session().busy(); }));
}

TEST_F(HostSpindleTest, no_program_starts_without_the_drive) {
  vfd.is_silent = true;
  turn(Seconds(3));
  EXPECT_EQ(run.refusal_of(start_of("M3 S1000\nM2\n")), "machine.not-ready");
  run.taken(request::Jog{.way = {.direction = test::xyz(1, 0), .speed = MmPerSecond(5)}});
  ASSERT_TRUE(turn_until([&] { return !run.session().busy(); }));
  EXPECT_GT(x(), 0);
}

TEST_F(HostSpindleTest, hold_keeps_it_door_stops_it_and_the_end_stops_it) {
  run.taken(start_of("G21 G90 M3 S9000\nG1 F300 X20\nM2\n"));
  ASSERT_TRUE(turn_until([&] { return x() > 0; }));
  run.taken(request::Hold{});
  ASSERT_TRUE(turn_until([&] { return run.rests(); }));
  turn(Seconds(2));
  EXPECT_EQ(vfd.direction, 1);
  run.taken(request::Resume{});
  turn(Seconds(0.5));
  run.taken(request::Hold{.for_door = true});
  ASSERT_TRUE(turn_until([&] { return run.rests(); }));
  turn(Seconds(2));
  EXPECT_EQ(vfd.direction, 0);
  const double at = x();
  run.taken(request::Resume{});
  ASSERT_TRUE(turn_until([&] { return x() != at; }));
  EXPECT_GE(vfd.speed, 0.95 * 9000);
  run.taken(request::Stop{});
  ASSERT_TRUE(turn_until([&] { return !run.session().busy(); }));
  turn(Seconds(0.1));
  EXPECT_EQ(vfd.direction, 0);
}

TEST_F(HostSpindleTest, a_stop_does_not_wait_for_the_speed) {
  vfd.rpm_a_second = 1000;
  run.taken(start_of("G21 G90 M3 S18000\nG1 F300 X20\nM2\n"));
  turn(Seconds(1));
  const Seconds asked = run.now();
  run.taken(request::Stop{});
  ASSERT_TRUE(turn_until([&] { return !run.session().busy(); }));
  EXPECT_LE((run.now() - asked).value(), 0.5);
  turn(Seconds(0.1));
  EXPECT_EQ(vfd.direction, 0);
  EXPECT_EQ(x(), 0);
}

TEST_F(HostSpindleTest, the_emergency_stop_stops_it) {
  run.taken(start_of("G21 G90 M3 S9000\nG1 F300 X20\nM2\n"));
  ASSERT_TRUE(turn_until([&] { return x() > 0; }));
  run.board().set_switch(input_emergency_stop, true);
  ASSERT_TRUE(turn_until(MachineState::alarm));
  turn(Seconds(0.1));
  EXPECT_EQ(vfd.direction, 0);
}

TEST_F(HostSpindleTest, a_lost_board_stops_it) {
  run.taken(start_of("G21 G90 M3 S9000\nG1 F300 X20\nM2\n"));
  ASSERT_TRUE(turn_until([&] { return x() > 0; }));
  run.line().set_trouble([](bool, VirtualLine::Bytes) { return VirtualLine::Bytes(); });
  ASSERT_TRUE(turn_until(MachineState::fault));
  turn(Seconds(0.1));
  EXPECT_EQ(vfd.direction, 0);
}

TEST_F(HostSpindleTest, the_override_changes_the_speed_without_a_stop) {
  run.taken(start_of("G21 G90 M3 S9000\nG1 F300 X20\nM2\n"));
  ASSERT_TRUE(turn_until([&] { return x() > 0; }));
  turn(Seconds(0.5));
  run.taken(request::Override{.spindle = 1.5});
  double last = x();
  int still = 0;
  for (int i = 0; i < 100; ++i) {
    turn(Seconds(0.02));
    still += x() == last ? 1 : 0;
    last = x();
  }
  EXPECT_EQ(still, 0);
  EXPECT_NEAR(vfd.speed, 13'500, 700);
  EXPECT_EQ(run.state(), MachineState::run);
}

}  // namespace
}  // namespace passo
