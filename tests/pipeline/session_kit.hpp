// A machine session on a virtual machine, in this process or at the end of a virtual line, and what is true of every
// turn: the states follow the table, each ticket is answered once, nothing moves in a state of rest, and the outputs
// are off where no program has them.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kit/example_machine.hpp"
#include "kit/step_log.hpp"

#include "passo/activity/machine_plant.hpp"
#include "passo/activity/stage_options.hpp"
#include "passo/machine/virtual_line.hpp"
#include "passo/machine/virtual_machine.hpp"
#include "passo/session/board_machine_session.hpp"

namespace passo::test {

struct SessionOn {
  bool line = false;
  KnownPosition start = {.place = Point(), .trust = Trust::commanded};
  Point stands_at = {};  // in truth
  std::vector<Touchable> touchables = {};
  HostSpindle* spindle = nullptr;
};

// A router that is homed in seconds.
inline MachineDescription short_router() {
  MachineDescription machine = example_machine("router");
  for (AxisDescription& axis : machine.axes) {
    axis.travel_low = -40;
    axis.travel_high = 40;
    if (axis.home) axis.home->switch_at = axis.home->toward_high ? 41 : -41;
  }
  return machine;
}

inline request::Start start_of(const std::string& text) {
  return {.program = ProgramReader::from_text("t", text), .options = {}};
}

class SessionRun {
 public:
  explicit SessionRun(const MachineDescription& machine, const SessionOn& on = {})
      : description_(machine),
        on_(on),
        board_(static_cast<std::uint8_t>(machine.axes.size()), machine.board.clock, machine.board.highest_event_rate,
               static_cast<std::size_t>(machine.board.held_items)),
        plant_(plant_of(machine, on.stands_at, on.touchables)),
        line_(board_, machine.board.clock, LineOptions{}),
        session_(description_, on.line ? static_cast<BoardPort&>(line_) : board_, options()) {
    board_.connect(plant_);
    board_.stand_at(steps_at(machine, on.stands_at));
    board_.add_observer(log);
  }
  SessionRun(const SessionRun&) = delete;
  SessionRun& operator=(const SessionRun&) = delete;
  ~SessionRun() {
    if (another_takes_changes) return;
    collect();
    if (!session_.busy()) {
      EXPECT_TRUE(waiting_.empty()) << waiting_.size() << " requests have no answer";
    }
  }

  StepLog log;
  std::vector<MachineChange> changes;  // all so far
  bool another_takes_changes = false;  // of the session, e.g. an API: then this sees none

  const MachineDescription& description() const { return description_; }
  BoardMachineSession& session() { return session_; }
  VirtualMachine& board() { return board_; }
  const VirtualMachine& board() const { return board_; }
  VirtualLine& line() { return line_; }
  IdealPlant& plant() { return plant_; }
  MachineState state() const { return session_.state(); }
  Seconds now() const { return session_.now(); }
  std::int64_t steps_made() const {
    std::int64_t steps = 0;
    for (const MotorCounts& motor : board_.counts().motors) steps += motor.total;
    return steps;
  }

  Result<Ticket, Refusal> ask(Request wanted) {
    auto answer = session_.request(std::move(wanted));
    if (answer) {
      EXPECT_TRUE(waiting_.insert({*answer, now()}).second) << "a ticket was given twice";
    }
    return answer;
  }
  Ticket taken(Request wanted) {
    const auto answer = ask(std::move(wanted));
    EXPECT_TRUE(answer) << name_of(state()) << ": " << answer.error().message();
    return answer ? *answer : 0;
  }
  // Empty: it was not refused.
  std::string refusal_of(Request wanted) {
    const auto answer = ask(std::move(wanted));
    return answer ? std::string() : std::string(code_of(answer.error().code()));
  }

  // Streams a line of a program that never ends.
  void stream(const std::string& line) {
    lines_ = std::make_unique<StreamedProgram>(description_, InterpreterOptions(), Point());
    const auto wrong = lines_->add_line(line, now());
    EXPECT_FALSE(wrong) << wrong->message;
    taken(request::Stream{.program = lines_.get()});
  }

  void poll(Seconds most = Seconds(0.02)) {
    const MachineState before = state();
    const std::int64_t steps = steps_made();
    session_.poll(most);
    collect();
    if (state() == before && !row_of(before).may_move) {
      EXPECT_EQ(steps_made(), steps) << "steps in " << name_of(before);
    }
    if (!row_of(state()).program_has_outputs) {
      EXPECT_EQ(board_.counts().outputs.switches, 0) << name_of(state());
    }
  }
  // False: that did not come about in time. Turns without time are not endless either.
  template <class Condition>
  bool turn_until(Condition condition, Seconds within = Seconds(120), Seconds most = Seconds(0.02)) {
    const Seconds end = now() + within;
    for (int turns = 0; !condition() && now() < end && turns < 10'000'000; ++turns) poll(most);
    return condition();
  }
  bool turn_until(MachineState wanted, Seconds within = Seconds(120)) {
    return turn_until([&] { return state() == wanted; }, within);
  }
  void pass(Seconds time) {
    const Seconds end = now() + time;
    static_cast<void>(turn_until([&] { return now() >= end - Seconds(1e-6); }));
  }
  void make_ready() { ASSERT_TRUE(turn_until(MachineState::idle)); }
  void to_end(Seconds within = Seconds(600)) {
    ASSERT_TRUE(turn_until([&] { return !session_.busy(); }, within)) << name_of(state());
  }
  // In a program: at rest.
  bool rests() const { return session_.status().rests; }

  std::optional<MachineChange> answer(Ticket ticket) const {
    const auto found = answers_.find(ticket);
    return found == answers_.end() ? std::nullopt : std::optional(found->second);
  }
  std::optional<Outcome> outcome(Ticket ticket) const {
    const auto found = answer(ticket);
    return found ? std::optional(found->outcome) : std::nullopt;
  }
  std::size_t count(MachineChange::Kind kind) const {
    std::size_t found = 0;
    for (const MachineChange& change : changes) found += change.kind == kind ? 1 : 0;
    return found;
  }
  // Each request that has not been answered.
  const std::map<Ticket, Seconds>& waiting() const { return waiting_; }

  // What the motors have truly done, in the steps of the session's place.
  std::array<double, StepLog::motors> steps_beside_place() const {
    std::array<double, StepLog::motors> beside{};
    const Kinematics kinematics = kinematics_of(description_);
    const MachineCounts counts = board_.counts();
    for (std::size_t m = 0; m < description_.axes.size(); ++m) {
      beside[m] = static_cast<double>(counts.motors[m].position) -
                  kinematics.rows()[m].steps.of(session_.status().position.place);
    }
    return beside;
  }
  // The motors stand where the session says, to the step, `away` from it since they were not homed.
  void expect_at_place(const std::array<double, StepLog::motors>& away = {}) const {
    const auto beside = steps_beside_place();
    for (std::size_t m = 0; m < description_.axes.size(); ++m) {
      EXPECT_NEAR(beside[m], away[m], 0.5 + 1e-6) << "motor " << m;
    }
  }

 private:
  SessionOptions options() const {
    if (!on_.line) return {.start = on_.start};
    return {.over_a_line = true,
            .care = {.answer_within = Seconds(0.05), .patience = Seconds(2)},
            .greeting = {.session = 1},
            .start = on_.start,
            .spindle = on_.spindle};
  }
  void collect() {
    for (MachineChange& change : session_.take_changes()) {
      if (change.kind == MachineChange::Kind::state) {
        bool follows = false;
        for (const Transition& one : transitions) follows = follows || (one.from == last_ && one.to == change.state);
        EXPECT_TRUE(follows) << name_of(last_) << " -> " << name_of(change.state);
        last_ = change.state;
      } else if (change.kind == MachineChange::Kind::answered) {
        EXPECT_EQ(waiting_.erase(change.ticket), 1U)
            << "ticket " << change.ticket << " was answered before, or never given";
        answers_[change.ticket] = change;
      }
      changes.push_back(std::move(change));
    }
    EXPECT_EQ(last_, state());
  }

  MachineDescription description_;
  SessionOn on_;
  VirtualMachine board_;
  IdealPlant plant_;
  VirtualLine line_;
  std::unique_ptr<StreamedProgram> lines_;
  BoardMachineSession session_;
  MachineState last_ = MachineState::offline;
  std::map<Ticket, Seconds> waiting_;  // and when they were asked
  std::map<Ticket, MachineChange> answers_;
};

}  // namespace passo::test
