// A machine session in each of its states: which requests it takes, as the table says, and what is true there.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "kit/stage_test.hpp"
#include "pipeline/session_kit.hpp"

namespace passo {
namespace {

using test::SessionRun;
using test::start_of;

// A state, and the way there.
struct Situation {
  const char* name;
  MachineState state;
  const char* program = "";  // that runs there
  bool held = false;         // by the operator or the door, so that it can be resumed
  bool waits = false;        // for the operator
};

constexpr const char* milling = "G21 G90 M3 S1000 M8\nG1 F600 X30\nX0\nM2\n";
const std::vector<Situation> situations = {
    {"offline", MachineState::offline},
    {"idle", MachineState::idle},
    {"run", MachineState::run, milling},
    {"hold", MachineState::hold, milling, true},
    {"program_stop", MachineState::hold, "G21 M3 S1000\nG4 P0.1\nM0\nG1 F600 X3\nM2\n", false, true},
    {"jog", MachineState::jog},
    {"home", MachineState::home},
    {"probe", MachineState::probe},
    {"await_line", MachineState::await_line},
    {"tool_change", MachineState::tool_change, "G21 M3 S1000\nT1 M6\nG1 F600 X3\nM2\n", false, true},
    {"check", MachineState::check},
    {"door", MachineState::door},
    {"door_in_program", MachineState::door, milling, true},
    {"alarm", MachineState::alarm},
    {"fault", MachineState::fault},
    {"sleep", MachineState::sleep},
};

request::Jog slow_jog() {
  return {.way = {.direction = test::xyz(1, 0.5), .speed = MmPerSecond(5)}, .lease = Seconds(5)};
}
request::Probe slow_probe() {
  return {.target = test::xyz(0, 0, -20), .speed = MmPerSecond(2)};
}
request::Check long_check() {
  std::string text = "G21 G90\n";
  for (int i = 0; i < 5000; ++i) text += i % 2 == 0 ? "G1 F600 X10\n" : "G1 F600 X0\n";
  return {.program = ProgramReader::from_text("t", text + "M2\n"), .options = {}};
}

std::unique_ptr<SessionRun> in(const Situation& situation) {
  auto run = std::make_unique<SessionRun>(test::short_router(), test::SessionOn{.line = true});
  if (situation.state == MachineState::offline) return run;
  run->make_ready();
  if (*situation.program != '\0') {
    run->taken(start_of(situation.program));
    if (situation.program == milling) run->pass(Seconds(0.5));
  }
  switch (situation.state) {
    case MachineState::hold:
      if (situation.held) run->taken(request::Hold{});
      EXPECT_TRUE(run->turn_until([&] { return run->state() == MachineState::hold && run->rests(); }));
      break;
    case MachineState::jog: run->taken(slow_jog()); break;
    case MachineState::home: run->taken(request::Home{}); break;
    case MachineState::probe: run->taken(slow_probe()); break;
    case MachineState::check: run->taken(long_check()); break;
    case MachineState::door: run->board().set_switch(input_door, true); break;
    case MachineState::alarm: run->board().set_switch(input_emergency_stop, true); break;
    case MachineState::fault: run->line().cut(run->now(), Seconds(1e6)); break;
    case MachineState::sleep: run->taken(request::Sleep{}); break;
    case MachineState::await_line: run->stream("G1 F600 X1"); break;
    default: break;
  }
  EXPECT_TRUE(run->turn_until(situation.state));
  if (situation.held) {
    EXPECT_TRUE(run->turn_until([&] { return run->rests(); }));
  }
  if (situation.state != MachineState::check) run->pass(Seconds(0.1));
  EXPECT_EQ(run->state(), situation.state);
  return run;
}

struct Asked {
  const char* name;
  Request (*request)();
  bool (*is_taken)(const Situation&);
};

template <MachineEvent event>
bool follows(const Situation& situation) {
  return next_state(situation.state, event).has_value();
}
bool is_active(const Situation& situation) {
  return row_of(situation.state).has_activity && (situation.state != MachineState::door || *situation.program != '\0');
}

const std::vector<Asked> requests = {
    {"start", [] { return Request(start_of("G21 G1 F600 X1\nM2\n")); }, follows<MachineEvent::begin_run>},
    {"jog", [] { return Request(slow_jog()); }, follows<MachineEvent::begin_jog>},
    {"renew_lease", [] { return Request(request::RenewKeepAlive{}); },
     [](const Situation& at) { return at.state == MachineState::jog; }},
    {"home", [] { return Request(request::Home{}); }, follows<MachineEvent::begin_home>},
    {"probe", [] { return Request(slow_probe()); }, follows<MachineEvent::begin_probe>},
    {"check", [] { return Request(long_check()); }, follows<MachineEvent::begin_check>},
    {"hold", [] { return Request(request::Hold{}); },
     [](const Situation& at) { return is_active(at) && at.state != MachineState::check; }},
    {"resume", [] { return Request(request::Resume{}); },
     [](const Situation& at) { return at.held && at.state != MachineState::door; }},
    {"stop", [] { return Request(request::Stop{}); }, is_active},
    {"override", [] { return Request(request::Override{.feed = 0.5}); }, [](const Situation&) { return true; }},
    {"choose_stops", [] { return Request(request::ChooseStops{.optional_stop = false}); },
     [](const Situation&) { return true; }},
    {"coolant", [] { return Request(request::SwitchOutputs{.flood = true}); },
     [](const Situation& at) { return *at.program != '\0' || at.state == MachineState::await_line; }},
    {"stop_spindle", [] { return Request(request::SwitchOutputs{.spindle_stands = true}); },
     [](const Situation& at) { return at.state == MachineState::hold; }},
    {"drop_lines", [] { return Request(request::DropLines{}); },
     [](const Situation& at) { return at.state == MachineState::await_line; }},
    {"operator_done", [] { return Request(request::OperatorDone{}); }, [](const Situation& at) { return at.waits; }},
    {"set_position", [] { return Request(request::SetPosition{{.place = test::xyz(1, 2), .trust = Trust::counted}}); },
     [](const Situation& at) { return at.state == MachineState::idle; }},
    {"reset", [] { return Request(request::ResetMachine{}); }, follows<MachineEvent::reset>},
    {"sleep", [] { return Request(request::Sleep{}); }, follows<MachineEvent::fall_asleep>},
    {"wake", [] { return Request(request::Wake{}); }, follows<MachineEvent::wake>},
};

// What comes after a request is turned too: each turn is looked at, and each ticket is answered.
TEST(SessionStates, take_just_the_requests_that_the_table_has) {
  for (const Situation& situation : situations) {
    for (const Asked& asked : requests) {
      SCOPED_TRACE(std::string(situation.name) + ", " + asked.name);
      const auto run = in(situation);
      const bool wanted = asked.is_taken(situation);
      const auto answer = run->ask(asked.request());
      ASSERT_EQ(answer.has_value(), wanted) << (answer ? "" : answer.error().message());
      if (!wanted) {
        EXPECT_EQ(run->state(), situation.state) << "a refusal changes nothing";
        EXPECT_FALSE(answer.error().message().empty());
      }
      for (int i = 0; i < 20; ++i) run->poll();
      if (run->session().busy()) {
        static_cast<void>(run->ask(request::Stop{}));
        run->to_end();
      }
    }
  }
}

TEST(SessionStates, say_why_they_refuse) {
  const auto code_in = [](MachineState state) {
    const auto found = std::ranges::find(situations, state, &Situation::state);
    return in(*found)->refusal_of(start_of("M2\n"));
  };
  EXPECT_EQ(code_in(MachineState::offline), "machine.not-ready");
  EXPECT_EQ(code_in(MachineState::run), "machine.busy");
  EXPECT_EQ(code_in(MachineState::check), "machine.busy");
  EXPECT_EQ(code_in(MachineState::door), "machine.door-open");
  EXPECT_EQ(code_in(MachineState::alarm), "machine.alarm");
  EXPECT_EQ(code_in(MachineState::fault), "machine.alarm");
  EXPECT_EQ(code_in(MachineState::sleep), "machine.asleep");
  EXPECT_EQ(in(situations[1])->refusal_of(request::Hold{}), "machine.nothing-runs");
  EXPECT_EQ(in(situations[1])->refusal_of(request::OperatorDone{}), "machine.not-waiting");
}

TEST(SessionStates, refuse_values_that_are_none) {
  const auto run = in(situations[1]);
  const double nan = std::nan("");
  const JogWay good{.direction = test::xyz(1, 0), .speed = MmPerSecond(1)};
  const auto refuses = [&](Request wanted) { EXPECT_EQ(run->refusal_of(std::move(wanted)), "machine.bad-value"); };
  refuses(request::Jog{.way = {.direction = Point(), .speed = MmPerSecond(1)}});
  refuses(request::Jog{.way = {.direction = test::xyz(nan, 0), .speed = MmPerSecond(1)}});
  refuses(request::Jog{.way = {.direction = test::xyz(1, 0), .speed = MmPerSecond(0)}});
  refuses(request::Jog{.way = {.direction = test::xyz(1, 0), .speed = MmPerSecond(1), .distance = Mm(-1)}});
  refuses(request::Jog{.way = good, .lease = Seconds(0.09)});
  refuses(request::Jog{.way = good, .lease = Seconds(10.1)});
  refuses(request::Probe{.target = test::xyz(0, nan), .speed = MmPerSecond(1)});
  refuses(request::Probe{.target = Point(), .speed = MmPerSecond(0)});
  refuses(request::Override{.feed = 2.01});
  refuses(request::Override{.feed = -0.01});
  refuses(request::Override{.adaptive_feed = 1.01});
  refuses(request::Override{.spindle = nan});
  refuses(request::Override{.rapids = 0.04});
  refuses(request::Override{.rapids = 1.01});
  refuses(request::SetPosition{{.place = test::xyz(nan, 0)}});
  EXPECT_EQ(run->state(), MachineState::idle);
}

TEST(SessionStates, without_switches_there_is_no_homing) {
  SessionRun run(test::example_machine("bench"));
  run.make_ready();
  EXPECT_EQ(run.refusal_of(request::Home{}), "machine.no-switches");
}

// While a program has its outputs they stay as the program says: in a hold, at an open door, at a tool change.
TEST(SessionStates, keep_the_outputs_of_a_program_that_rests) {
  for (const char* name : {"run", "hold", "door_in_program"}) {
    const auto found =
        std::ranges::find_if(situations, [&](const Situation& one) { return one.name == std::string(name); });
    const auto run = in(*found);
    EXPECT_EQ(run->board().counts().outputs.switches, spindle_on | flood_on) << name;
    EXPECT_TRUE(run->session().status().outputs.flood) << name;
  }
}

// Its spindle still turns when a program breaks off amid the run.
TEST(SessionStates, a_program_that_cannot_go_on_leaves_no_output_on) {
  for (const bool line : {false, true}) {
    SCOPED_TRACE(line ? "over a line" : "direct");
    SessionRun run(test::short_router(), {.line = line});
    run.make_ready();
    const Ticket ticket = run.taken(start_of("G21 G90 M3 S1000 M8\nG1 F600 X5\nX9999\nM2\n"));
    run.to_end();
    EXPECT_EQ(run.state(), MachineState::idle);
    EXPECT_EQ(run.outcome(ticket), Outcome::failed);
    EXPECT_EQ(run.board().counts().outputs.switches, 0);
    run.expect_at_place();
  }
}

TEST(SessionStates, a_check_moves_nothing_and_tells_what_it_finds) {
  SessionRun run(test::short_router());
  run.make_ready();
  const Ticket good = run.taken(long_check());
  run.to_end();
  EXPECT_EQ(run.outcome(good), Outcome::done);
  Diagnostics findings;
  const Ticket bad = run.taken(request::Check{
      .program = ProgramReader::from_text("t", "G1 F100 X9999\n"), .options = {}, .findings = &findings});
  run.to_end();
  EXPECT_EQ(run.outcome(bad), Outcome::failed);
  EXPECT_TRUE(findings.any_error());
  const Ticket stopped = run.taken(long_check());
  run.taken(request::Stop{});
  run.to_end();
  EXPECT_EQ(run.outcome(stopped), Outcome::stopped);
  EXPECT_EQ(run.board().counts().events, 0);
}

TEST(SessionStates, a_probe_move_ends_at_what_it_touches) {
  for (const bool line : {false, true}) {
    SCOPED_TRACE(line ? "over a line" : "direct");
    TouchBox table;
    table.ranges[Axis::z].high = -3;
    SessionRun run(test::short_router(), {.line = line, .touchables = {table}});
    run.make_ready();
    const Ticket ticket = run.taken(slow_probe());
    run.to_end();
    EXPECT_EQ(run.outcome(ticket), Outcome::done);
    ASSERT_EQ(run.count(MachineChange::Kind::probed), 1U);
    const auto found = std::ranges::find(run.changes, MachineChange::Kind::probed, &MachineChange::kind);
    EXPECT_TRUE(found->probe->touched);
    EXPECT_NEAR(found->probe->contact[Axis::z], -3, 1.0 / 640);
    run.expect_at_place();
    // Free again, and from there nothing is met.
    EXPECT_EQ(
        run.outcome(run.taken(request::Probe{.target = test::xyz(0, 0, 5), .speed = MmPerSecond(5), .toward = false})),
        std::nullopt);
    run.to_end();
    const Ticket missed = run.taken(request::Probe{.target = test::xyz(5, 0, 5), .speed = MmPerSecond(5)});
    run.to_end();
    EXPECT_EQ(run.outcome(missed), Outcome::failed);
  }
}

}  // namespace
}  // namespace passo
