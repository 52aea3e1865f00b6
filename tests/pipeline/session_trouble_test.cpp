// What a machine session does when something breaks: the line, the board, the counts; and how it gets up again.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "kit/random_point.hpp"
#include "kit/stage_test.hpp"
#include "pipeline/session_kit.hpp"

#include "passo/wire/decoder.hpp"

namespace passo {
namespace {

using test::SessionRun;
using test::start_of;
using test::xyz;

constexpr const char* cutting = "G21 G90 M3 S1000 G1 F1200\nX30\nX0 Y10\nM2\n";
// More than a line is waited for.
constexpr Seconds long_cut{3};

void expect_refuses_all_but_a_reset(SessionRun& run) {
  EXPECT_EQ(run.refusal_of(start_of("M2\n")), "machine.alarm");
  EXPECT_EQ(run.refusal_of(request::Home{}), "machine.alarm");
  EXPECT_EQ(run.refusal_of(request::Jog{.way = {.direction = xyz(1, 0), .speed = MmPerSecond(1)}}), "machine.alarm");
  EXPECT_EQ(run.refusal_of(request::SetPosition{}), "machine.alarm");
  EXPECT_EQ(run.refusal_of(request::Hold{}), "machine.nothing-runs");
  EXPECT_EQ(run.refusal_of(request::Stop{}), "machine.nothing-runs");
  EXPECT_FALSE(run.session().status().trouble_sentence.text.empty());
  EXPECT_EQ(run.session().status().position.trust, Trust::unknown);
}

// It moves, and its counts are compared with what was commanded from where it stands.
void expect_works(SessionRun& run) {
  const Ticket ticket = run.taken(start_of("G21 G91 G1 F1200 X2\nX-1 Y1\nM2\n"));
  run.to_end();
  EXPECT_EQ(run.outcome(ticket), Outcome::done);
  EXPECT_EQ(run.state(), MachineState::idle);
  EXPECT_EQ(run.count(MachineChange::Kind::position_lost), 0U);
}

class Trouble : public testing::TestWithParam<bool> {
 protected:
  test::SessionOn on() const { return {.line = GetParam()}; }
};
INSTANTIATE_TEST_SUITE_P(, Trouble, testing::Bool(),
                         [](const auto& line) { return std::string(line.param ? "over_a_line" : "direct"); });

TEST_P(Trouble, an_emergency_stop_is_an_alarm_until_it_is_released_and_reset) {
  for (const bool amid_run : {false, true}) {
    SCOPED_TRACE(amid_run);
    SessionRun run(test::short_router(), on());
    run.make_ready();
    Ticket program = 0;
    Ticket hold = 0;
    if (amid_run) {
      program = run.taken(start_of(cutting));
      run.pass(Seconds(0.7));
      hold = run.taken(request::Hold{});
    }
    run.board().set_switch(input_emergency_stop, true);
    ASSERT_TRUE(run.turn_until(MachineState::alarm, Seconds(0.5)));
    EXPECT_EQ(run.session().status().trouble, LinkError::stopped);
    if (amid_run) {
      EXPECT_EQ(run.outcome(program), Outcome::failed);
      EXPECT_EQ(run.answer(program)->fault->fault, MachineFault::board_stopped);
      EXPECT_EQ(run.outcome(hold), Outcome::failed);
    }
    expect_refuses_all_but_a_reset(run);
    // The button is still pressed.
    run.taken(request::ResetMachine{});
    EXPECT_EQ(run.state(), MachineState::offline);
    ASSERT_TRUE(run.turn_until([&] { return run.state() != MachineState::offline; }, Seconds(1)));
    ASSERT_TRUE(run.turn_until(MachineState::alarm, Seconds(1)));
    run.board().set_switch(input_emergency_stop, false);
    run.taken(request::ResetMachine{});
    ASSERT_TRUE(run.turn_until(MachineState::idle, Seconds(1)));
    run.pass(Seconds(0.5));
    EXPECT_EQ(run.state(), MachineState::idle);
    EXPECT_EQ(run.session().status().position.trust, Trust::unknown) << "steps may be lost";
    EXPECT_FALSE(run.session().status().trouble);
    expect_works(run);
    const Ticket home = run.taken(request::Home{});
    run.to_end();
    EXPECT_EQ(run.outcome(home), Outcome::done);
    EXPECT_EQ(run.session().status().position.trust, Trust::homed);
    run.expect_at_place();
  }
}

TEST_P(Trouble, a_limit_switch_amid_motion_is_an_alarm) {
  test::SessionOn wrong = on();
  wrong.stands_at = xyz(-30, 0);  // and is thought to stand at 0
  SessionRun run(test::short_router(), wrong);
  run.make_ready();
  const Ticket program = run.taken(start_of("G21 G90 G1 F1200 X-30\nM2\n"));
  ASSERT_TRUE(run.turn_until(MachineState::alarm, Seconds(5)));
  EXPECT_EQ(run.outcome(program), Outcome::failed);
  expect_refuses_all_but_a_reset(run);
  run.taken(request::ResetMachine{});
  ASSERT_TRUE(run.turn_until(MachineState::idle, Seconds(1)));
  const Ticket home = run.taken(request::Home{});
  run.to_end();
  EXPECT_EQ(run.outcome(home), Outcome::done);
  run.expect_at_place();
}

// At any moment of a run. The board plays its tail to the end, and has counted all.
TEST(LineTrouble, a_cut_is_a_fault_and_after_a_reset_the_place_is_what_the_board_has_counted) {
  for (const double at : {-1.0, 0.0, 0.3, 0.711, 1.5, 2.2}) {
    SCOPED_TRACE(at);
    SessionRun run(test::short_router(), {.line = true});
    run.make_ready();
    run.taken(request::Home{});
    run.to_end();
    Ticket program = 0;
    if (at >= 0) program = run.taken(start_of(cutting));
    if (at > 0) run.pass(Seconds(at));
    run.line().cut(run.now(), long_cut);
    ASSERT_TRUE(run.turn_until(MachineState::fault, Seconds(3)));
    if (at >= 0) {
      EXPECT_EQ(run.outcome(program), Outcome::failed);
      EXPECT_EQ(run.answer(program)->fault->fault, MachineFault::board_lost);
    }
    expect_refuses_all_but_a_reset(run);
    // Too early: still cut. That forgets nothing.
    run.taken(request::ResetMachine{});
    EXPECT_EQ(run.state(), MachineState::offline);
    ASSERT_TRUE(run.turn_until([&] { return run.state() != MachineState::offline; }, Seconds(4)));
    if (run.state() == MachineState::fault) {
      run.pass(Seconds(1));
      run.taken(request::ResetMachine{});
    }
    ASSERT_TRUE(run.turn_until(MachineState::idle, Seconds(1)));
    EXPECT_EQ(run.session().status().position.trust, Trust::homed);
    run.expect_at_place();
    expect_works(run);
    run.expect_at_place();
  }
}

// Motors that are stopped so suddenly may lose steps, although the board has made them all. Early in a program and in
// its last move, of which the board holds all when it stands still.
TEST(LineTrouble, a_standstill_amid_motion_is_an_alarm_and_the_place_is_not_trusted_after_it) {
  for (const double at : {0.7, 3.9}) {
    SCOPED_TRACE(at);
    SessionRun run(test::short_router(), {.line = true});
    run.make_ready();
    run.taken(request::Home{});
    run.to_end();
    const Ticket program = run.taken(start_of(cutting));
    run.pass(Seconds(at));
    ASSERT_EQ(run.board().counts().outputs.switches, unsigned{spindle_on});
    run.board().stand_still(Ticks{2000});
    // From here on run.poll() sees neither a step nor an output that is on.
    ASSERT_TRUE(run.turn_until(MachineState::alarm, Seconds(0.7)));
    EXPECT_EQ(run.session().status().trouble, LinkError::stood_still);
    EXPECT_EQ(run.outcome(program), Outcome::failed);
    EXPECT_EQ(run.answer(program)->fault->fault, MachineFault::board_slipped);
    EXPECT_NE(run.session().status().trouble_sentence.text.find("near line " + std::string(at < 1 ? "2" : "3")),
              std::string::npos)
        << run.session().status().trouble_sentence.text;
    run.pass(Seconds(4));
    expect_refuses_all_but_a_reset(run);
    run.taken(request::ResetMachine{});
    ASSERT_TRUE(run.turn_until(MachineState::idle, Seconds(1)));
    EXPECT_EQ(run.session().status().position.trust, Trust::unknown) << "steps may be lost";
    expect_works(run);
  }
}

// Whatever moves: the drive brakes, and nothing moves or is switched on in the alarm.
TEST(LineTrouble, a_standstill_ends_a_jog_a_homing_cycle_a_probe_move_and_a_stream_at_rest) {
  const std::vector<std::function<void(SessionRun&)>> works{
      [](SessionRun& run) {
        run.taken(request::Jog{.way = {.direction = xyz(1, 0), .speed = MmPerSecond(20)}, .lease = Seconds(10)});
      },
      [](SessionRun& run) { run.taken(request::Home{}); },
      [](SessionRun& run) { run.taken(request::Probe{.target = Point{xyz(40, 0)}, .speed = MmPerSecond(10)}); },
      [](SessionRun& run) { run.stream("G21 G90 M3 S1000 G1 F1200 X30"); }};
  for (std::size_t i = 0; i < works.size(); ++i) {
    SCOPED_TRACE(i);
    SessionRun run(test::short_router(), {.line = true, .start = {.place = Point(), .trust = Trust::commanded}});
    run.make_ready();
    works[i](run);
    run.pass(Seconds(0.5));
    const std::int64_t steps = run.steps_made();
    ASSERT_GT(steps, 0);
    run.board().stand_still(Ticks{2000});
    ASSERT_TRUE(run.turn_until(MachineState::alarm, Seconds(0.7)));
    EXPECT_EQ(run.session().status().trouble, LinkError::stood_still);
    EXPECT_GT(run.steps_made(), steps) << "it braked";
    run.pass(Seconds(2));
    expect_refuses_all_but_a_reset(run);
  }
}

TEST(LineTrouble, a_reset_that_comes_to_a_line_that_is_still_cut_forgets_nothing) {
  SessionRun run(test::short_router(), {.line = true, .start = {.place = Point(), .trust = Trust::homed}});
  run.make_ready();
  run.taken(start_of(cutting));
  run.pass(Seconds(0.7));
  run.line().cut(run.now(), Seconds(10));
  ASSERT_TRUE(run.turn_until(MachineState::fault, Seconds(3)));
  for (int i = 0; i < 2; ++i) {
    run.taken(request::ResetMachine{});
    ASSERT_TRUE(run.turn_until(MachineState::fault, Seconds(3)));
    expect_refuses_all_but_a_reset(run);
  }
  run.pass(Seconds(10));
  run.taken(request::ResetMachine{});
  ASSERT_TRUE(run.turn_until(MachineState::idle, Seconds(1)));
  EXPECT_EQ(run.session().status().position.trust, Trust::homed);
  run.expect_at_place();
  expect_works(run);
}

TEST(LineTrouble, a_reset_out_of_idle_keeps_the_place_that_the_counts_prove) {
  SessionRun run(test::short_router(), {.line = true});
  run.make_ready();
  run.taken(request::Home{});
  run.to_end();
  run.taken(start_of("G21 G90 G1 F1200 X1.2345 Y3\nM2\n"));
  run.to_end();
  run.taken(request::ResetMachine{});
  ASSERT_TRUE(run.turn_until(MachineState::idle, Seconds(1)));
  EXPECT_EQ(run.session().status().position.trust, Trust::homed);
  EXPECT_NEAR(run.session().status().position.place[Axis::x], 1.2345, 1.0 / 640);
  run.expect_at_place();
  expect_works(run);
  run.expect_at_place();
}

// A cut that is shorter than the patience: the session goes on by itself.
TEST(LineTrouble, a_short_cut_is_survived) {
  SessionRun run(test::short_router(), {.line = true});
  run.make_ready();
  const Ticket program = run.taken(start_of(cutting));
  run.pass(Seconds(0.7));
  run.line().cut(run.now(), Seconds(1));
  run.to_end();
  EXPECT_EQ(run.outcome(program), Outcome::done);
  EXPECT_EQ(run.count(MachineChange::Kind::rested_by_tail), 1U);
  EXPECT_EQ(run.session().status().position.trust, Trust::counted);
  run.expect_at_place();
}

// A cut that is longer than the board's patience with a silent host, and shorter than the host's: the spindle stands
// while the line is away, and turns again for the stated time before anything moves.
TEST(LineTrouble, outputs_end_with_a_long_silence_and_come_back_before_the_motion_does) {
  for (const double allowed : {0.5, 0.0}) {
    SCOPED_TRACE(allowed);
    MachineDescription machine = test::short_router();
    machine.silence = {
        .spindle = Seconds(allowed), .mist = Seconds(0), .flood = Seconds(0), .spindle_wait = Seconds(3)};
    SessionRun run(machine, {.line = true});
    run.make_ready();
    const Ticket program = run.taken(start_of("G21 G90 M3 S1000 M8 G1 F1200\nX30\nX0 Y10\nM2\n"));
    run.pass(Seconds(0.7));
    run.line().cut(run.now(), Seconds(1.9));
    run.pass(Seconds(1.8));
    const std::int64_t steps = run.steps_made();
    const unsigned left = run.board().counts().outputs.switches;
    EXPECT_EQ(left, allowed > 0 ? unsigned{flood_on} : unsigned{spindle_on | flood_on});
    ASSERT_TRUE(run.turn_until([&] { return (run.board().counts().outputs.switches & spindle_on) != 0; }));
    EXPECT_EQ(run.steps_made(), steps);
    const Seconds on_again = run.now();
    ASSERT_TRUE(run.turn_until([&] { return run.steps_made() != steps; }));
    if (allowed > 0) {
      EXPECT_GE(run.now() - on_again, Seconds(2.9));
    } else {
      EXPECT_LT(run.now() - on_again, Seconds(1));
    }
    run.to_end();
    EXPECT_EQ(run.outcome(program), Outcome::done);
    EXPECT_EQ(run.session().status().position.trust, Trust::counted);
    run.expect_at_place();
  }
}

// As after a reset of the board: it knows no session, and where the motors are is no longer certain.
void make_board_forget(SessionRun& run) {
  std::uint8_t frame[largest_frame];
  const Hello hello{.version = protocol_version, .motors = static_cast<std::uint8_t>(run.description().axes.size())};
  const std::uint8_t size = encode(hello, 0, frame);
  run.board().receive({frame, size});
}

TEST(LineTrouble, a_board_that_was_reset_is_a_fault_and_its_place_is_unknown) {
  for (const bool in_hold : {false, true}) {
    SCOPED_TRACE(in_hold);
    SessionRun run(test::short_router(), {.line = true, .start = {.place = Point(), .trust = Trust::homed}});
    run.make_ready();
    Ticket program = 0;
    if (in_hold) {
      program = run.taken(start_of("G21 G1 F1200 X3\nM0\nX6\nM2\n"));
      ASSERT_TRUE(run.turn_until(MachineState::hold));
    }
    make_board_forget(run);
    ASSERT_TRUE(run.turn_until(MachineState::fault, Seconds(3)));
    EXPECT_EQ(run.session().status().trouble, LinkError::was_reset);
    if (in_hold) {
      EXPECT_EQ(run.outcome(program), Outcome::failed);
    }
    expect_refuses_all_but_a_reset(run);
    run.taken(request::ResetMachine{});
    ASSERT_TRUE(run.turn_until(MachineState::idle, Seconds(1)));
    EXPECT_EQ(run.session().status().position.trust, Trust::unknown);
    expect_works(run);
    EXPECT_EQ(run.session().status().position.trust, Trust::unknown);
  }
}

// What the board says of its first motor's place is off by so many steps.
class WrongCounts {
 public:
  explicit WrongCounts(std::uint8_t motors) : motors_(motors) { decoder_.set_motors(motors); }
  std::int32_t off = 0;

  VirtualLine::Bytes operator()(bool to_board, const VirtualLine::Bytes& bytes) {
    if (to_board) return bytes;
    VirtualLine::Bytes passed;
    for (const std::uint8_t byte : bytes) {
      frame_.push_back(byte);
      if (decoder_.feed(byte) != Decoded::frame) continue;
      if (decoder_.frame().type == MessageType::status) {
        BoardStatus status;
        decode(decoder_.frame(), motors_, status);
        status.positions[0] += off;
        std::uint8_t again[largest_frame];
        const std::uint8_t size = encode(status, motors_, decoder_.frame().sequence, again);
        frame_.assign(again, again + size);
      }
      passed.insert(passed.end(), frame_.begin(), frame_.end());
      frame_.clear();
    }
    return passed;
  }

 private:
  std::uint8_t motors_;
  Decoder decoder_;
  VirtualLine::Bytes frame_;
};

TEST(LineTrouble, counts_that_differ_are_a_lost_position) {
  SessionRun run(test::short_router(), {.line = true});
  WrongCounts counts(static_cast<std::uint8_t>(run.description().axes.size()));
  run.line().set_trouble([&](bool to_board, const VirtualLine::Bytes& bytes) { return counts(to_board, bytes); });
  run.make_ready();
  run.taken(request::Home{});
  run.to_end();
  EXPECT_EQ(run.session().status().position.trust, Trust::homed);
  run.taken(start_of("G21 G91 G1 F1200 X1\n"));
  counts.off = -3;
  run.to_end();
  EXPECT_EQ(run.count(MachineChange::Kind::position_lost), 1U);
  EXPECT_EQ(run.session().status().position.trust, Trust::unknown);
  ASSERT_TRUE(run.session().mismatch());
  EXPECT_EQ(run.session().mismatch()->motor, 0U);
  EXPECT_EQ(run.session().mismatch()->counted - run.session().mismatch()->commanded, -3);
  // The same loss is not told again, and homing finds the place again.
  run.taken(start_of("G21 G91 G1 F1200 X1\n"));
  run.to_end();
  EXPECT_EQ(run.count(MachineChange::Kind::position_lost), 1U);
  EXPECT_EQ(run.session().status().position.trust, Trust::unknown);
  run.taken(request::Home{});
  run.to_end();
  EXPECT_EQ(run.session().status().position.trust, Trust::homed);
  EXPECT_FALSE(run.session().mismatch());
}

// The board watches a limit switch then, which must stop the motors again, and what was found is nothing to the next.
TEST_P(Trouble, a_homing_that_was_stopped_anywhere_leaves_no_watch_behind) {
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE(i);
    SessionRun run(test::short_router(), on());
    run.make_ready();
    const Ticket home = run.taken(request::Home{});
    run.pass(Seconds(0.05 + 0.25 * i));
    if (!run.session().busy()) break;
    run.taken(request::Stop{});
    run.to_end();
    EXPECT_EQ(run.outcome(home), Outcome::stopped);
    run.expect_at_place();
    const Ticket jog = run.taken(request::Jog{
        .way = {.direction = xyz(1, 1, -1), .speed = MmPerSecond(20), .distance = Mm(5)}, .lease = Seconds(5)});
    run.to_end();
    EXPECT_EQ(run.outcome(jog), Outcome::done);
    run.expect_at_place();
    // Every limit switch stops the motors.
    run.taken(request::Jog{.way = {.direction = xyz(1, 0, -1), .speed = MmPerSecond(5), .distance = Mm(5)},
                           .lease = Seconds(5)});
    run.pass(Seconds(0.2));
    run.board().set_switch(static_cast<std::uint16_t>(input_limit << (i % 3)), true);
    ASSERT_TRUE(run.turn_until(MachineState::alarm, Seconds(0.5)));
  }
}

Request any_request(test::Random& random) {
  const auto place = [&] { return test::random_point(random, 10); };
  switch (static_cast<int>(random.between(0, 17))) {
    case 0: return start_of("G21 G90 M3 S500 G1 F1800 X5\nM0\nX-5 Y3\nT1 M6\nG4 P0.5\nG1 Y-5\nM2\n");
    case 1: return start_of(cutting);
    case 2: return start_of("G21 G90 M3 S500 G38.3 Z-1 F300\nG53 G1 X#5061 F900\nX9999\nM2\n");  // fails
    case 3:
    case 4:
      return request::Jog{.way = {.direction = place(), .speed = MmPerSecond(random.between(1, 50))},
                          .lease = Seconds(0.3)};
    case 5: return request::RenewKeepAlive{};
    case 6: return request::Home{};
    case 7: return request::Probe{.target = place(), .speed = MmPerSecond(10), .toward = random.chance(0.5)};
    case 8: return request::Check{.program = ProgramReader::from_text("t", cutting), .options = {}};
    case 9: return request::Hold{};
    case 10: return request::Resume{};
    case 11: return request::Stop{};
    case 12: return request::Override{.feed = random.chance(0.2) ? 0 : random.between(0.1, 2), .spindle = 1.2};
    case 13: return request::OperatorDone{};
    case 14: return request::SetPosition{{.place = place(), .trust = Trust::commanded}};
    case 15: return request::ResetMachine{};
    default:
      if (random.chance(0.5)) return request::Sleep{};
      return request::Wake{};
  }
}

// A button, the door, or the line.
void make_trouble(SessionRun& run, test::Random& random, bool line) {
  const bool on = random.chance(0.4);
  const double kind = random.between(0, 1);
  if (kind < 0.2)
    run.board().set_switch(input_emergency_stop, on);
  else if (kind < 0.45)
    run.board().set_switch(input_door, on);
  else if (kind < 0.7)
    run.board().set_switch(input_hold, on);
  else if (kind < 0.9)
    run.board().set_switch(input_start, on);
  else if (line)
    run.line().cut(run.now(), Seconds(random.between(0, 3)));
}

// SessionRun looks at each turn. In the end the machine can be made to work again.
TEST_P(Trouble, whatever_is_asked_and_whatever_breaks_each_request_is_answered_once) {
  constexpr int trials = 24;
  test::Random random;
  int homed = 0;
  for (int i = 0; i < trials; ++i) {
    SCOPED_TRACE(i);
    SessionRun run(test::short_router(), on());
    for (int k = 0; k < 60; ++k) {
      static_cast<void>(run.ask(any_request(random)));
      if (random.chance(0.1)) make_trouble(run, random, GetParam());
      run.pass(Seconds(random.chance(0.7) ? random.between(0, 0.3) : random.between(0, 3)));
    }
    run.board().set_switch(input_emergency_stop | input_door | input_hold | input_start, false);
    static_cast<void>(run.ask(request::Override{.feed = 1.0, .spindle = 1.0}));
    static_cast<void>(run.ask(request::Stop{}));
    static_cast<void>(run.ask(request::Wake{}));
    run.pass(Seconds(5));
    for (int k = 0; k < 3 && run.state() != MachineState::idle; ++k) {
      static_cast<void>(run.ask(request::ResetMachine{}));
      run.pass(Seconds(5));
    }
    ASSERT_EQ(run.state(), MachineState::idle);
    EXPECT_TRUE(run.waiting().empty());
    const Ticket home = run.taken(request::Home{});
    run.to_end();
    // Who says a wrong place may have driven the machine past its switches: the motors do what they are told all the
    // same.
    if (run.outcome(home) == Outcome::done) {
      ++homed;
      run.expect_at_place();
    } else {
      ASSERT_TRUE(run.answer(home)->fault);
      EXPECT_TRUE(run.answer(home)->fault->code().starts_with("home.")) << run.answer(home)->fault->code();
    }
    ASSERT_FALSE(HasFailure()) << "seed " << random.seed();
  }
  std::printf("%d of %d machines could be homed in the end\n", homed, trials);
  EXPECT_GT(homed, trials / 2);
}

TEST(LineTrouble, a_board_that_does_not_suit_is_a_fault) {
  const MachineDescription router = test::short_router();
  MachineDescription other = router;
  other.board.clock = Hertz(router.board.clock.value() / 2);
  VirtualMachine board(3, router.board.clock);
  BoardMachineSession session(other, board);
  for (int i = 0; i < 10; ++i) session.poll(Seconds(0.1));
  EXPECT_EQ(session.state(), MachineState::fault);
  EXPECT_NE(session.trouble_words().find("its clock"), std::string::npos) << session.trouble_words();
}

TEST(LineTrouble, a_session_that_nobody_turns_forgets_the_oldest_changes_and_no_state) {
  SessionRun run(test::short_router());
  run.make_ready();
  for (int i = 0; i < 10'000; ++i) {
    EXPECT_TRUE(run.session().request(request::Override{.feed = 1.0}));
  }
  EXPECT_EQ(run.session().take_changes().size(), 4096U);
  EXPECT_EQ(run.state(), MachineState::idle);
}

}  // namespace
}  // namespace passo
