// A soak: three clients, one session, a line that breaks and people who press what they find, for hours of virtual
// time. PASSO_SOAK_HOURS says how many; what must be true is looked at after each turn.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "homing_kit.hpp"
#include "kit/in_full.hpp"
#include "kit/soak_world.hpp"
#include "soak_client.hpp"
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "passo/activity/stage_options.hpp"
#include "passo/session/board_machine_session.hpp"

namespace passo::test {
namespace {

constexpr std::array names = {"start", "stream",     "drop lines",   "jog",    "renew", "home",     "probe",
                              "check", "board file", "hold",         "resume", "stop",  "override", "switch",
                              "stops", "done",       "set position", "reset",  "sleep", "wake"};
static_assert(names.size() == std::variant_size_v<Request>);

constexpr LinkTimeouts care{.answer_within = Seconds(0.05), .patience = Seconds(3)};
// What somebody has asked to end is at an end after so long, however bad the line.
constexpr Seconds longest_stop{60};

// Kilobytes that the process has had at most.
long most_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

class SessionSoak : public testing::Test {
 protected:
  SessionSoak()
      : random_(),
        world_(description_, Random::of(random_.seed() + 1), xyz(20, -30, 10)),
        session_(description_, world_.line,
                 {.over_a_line = true, .care = care, .greeting = {.session = 1}, .start = {}}) {
    for (std::uint64_t i = 0; i < 3; ++i) clients_.emplace_back(description_, Random::of(random_.seed() + 2 + i));
  }

  void soak(Seconds time) {
    while (session_.now() < time && !HasFailure()) {
      if (const char* const happened = world_.act(session_.state() == MachineState::home)) tell(happened);
      fooled_ = fooled_ || (world_.fools() && session_.state() == MachineState::home);
      for (SoakClient& client : clients_) {
        if (std::optional<Request> wanted = client.act(session_.status())) ask(std::move(*wanted));
      }
      poll();
    }
  }

  void poll() {
    const MachineState before = session_.state();
    const std::int64_t steps = world_.limits.steps();
    session_.poll(random_.chance(0.9) ? Seconds(0.02) : Seconds(random_.between(0, 0.3)));
    ++turns_;
    take_changes();
    world_.limits.look_until(world_.machine.now());
    EXPECT_FALSE(world_.limits.violation()) << *world_.limits.violation() << at();
    if (!row_of(before).may_move && !row_of(session_.state()).may_move) {
      EXPECT_EQ(world_.limits.steps(), steps) << "motion in " << name_of(before) << at();
    }
    expect_outputs();
    expect_place();
    expect_answers();
  }

  // --- Requests and their answers.

  // Whether the state as it is has to refuse; nothing: the values may be bad.
  static std::optional<bool> must_refuse(const Request& wanted, const BoardMachineSession& session) {
    const MachineStatus status = session.status();
    const MachineState state = status.state;
    const bool runs = status.activity == ActivityKind::program;
    const auto no_way = [&](MachineEvent event) { return !next_state(state, event); };
    struct Rules {
      const decltype(no_way)& lacks;
      const MachineStatus& status;
      bool busy, runs;
      bool operator()(const request::Start&) const { return lacks(MachineEvent::begin_run); }
      bool operator()(const request::Stream&) const { return lacks(MachineEvent::begin_run); }
      bool operator()(const request::DropLines&) const { return true; }  // nothing here comes line by line
      bool operator()(const request::Jog&) const { return lacks(MachineEvent::begin_jog); }
      bool operator()(const request::RenewKeepAlive&) const { return status.state != MachineState::jog; }
      bool operator()(const request::Home&) const { return lacks(MachineEvent::begin_home); }
      bool operator()(const request::Probe&) const { return lacks(MachineEvent::begin_probe); }
      bool operator()(const request::Check&) const { return lacks(MachineEvent::begin_check); }
      bool operator()(const request::RunBoardFile&) const { return true; }  // the board stores no files
      bool operator()(const request::Hold&) const { return !busy || status.state == MachineState::check; }
      bool operator()(const request::Resume&) const {
        return !runs || status.holds.has(HoldReason::stop) ||
               !status.holds.any_of({HoldReason::operator_hold, HoldReason::door, HoldReason::line_end}) ||
               (status.inputs & input_door) != 0;
      }
      bool operator()(const request::Stop&) const { return !busy; }
      bool operator()(const request::Override&) const { return false; }
      bool operator()(const request::SwitchOutputs&) const { return !runs; }  // nobody here asks for that
      bool operator()(const request::ChooseStops&) const { return false; }
      bool operator()(const request::OperatorDone&) const { return !status.waits_for; }
      bool operator()(const request::SetPosition&) const { return status.state != MachineState::idle; }
      bool operator()(const request::ResetMachine&) const { return lacks(MachineEvent::reset); }
      bool operator()(const request::Sleep&) const { return lacks(MachineEvent::fall_asleep); }
      bool operator()(const request::Wake&) const { return lacks(MachineEvent::wake); }
    };
    return std::visit(Rules{no_way, status, session.busy(), runs}, wanted);
  }

  void ask(Request wanted) {
    ++requests_;
    const std::size_t kind = wanted.index();
    const bool refuses = *must_refuse(wanted, session_);
    if (std::holds_alternative<request::Home>(wanted) && session_.state() == MachineState::idle &&
        session_.status().position.trust == Trust::unknown) {
      world_.turn_back();
    }
    std::optional<Point> place;
    if (auto* const set = std::get_if<request::SetPosition>(&wanted)) {
      if (random_.chance(0.7)) set->position.place = true_place();
      place = set->position.place;
    }
    const auto answer = session_.request(std::move(wanted));
    tell(fmt::format("{} {}", names[kind], answer ? "taken" : answer.error().message()));
    if (!answer) {
      ++refused_;
      EXPECT_FALSE(answer.error().message().empty());
      const bool is_barred = answer.error().code() == RefusalCode::limit_closed && session_.closed_limit();
      EXPECT_TRUE(refuses || is_barred || answer.error().code() == RefusalCode::bad_value)
          << answer.error().message() << at();
    } else {
      EXPECT_FALSE(refuses) << "request " << kind << " was taken" << at();
      EXPECT_TRUE(open_.emplace(*answer, Open{.kind = kind, .since = session_.now()}).second)
          << "a ticket twice" << at();
      ++taken_[kind];
      if (place) measure(*place);
    }
    take_changes();
  }

  void take_changes() {
    for (const MachineChange& change : session_.take_changes()) {
      if (change.kind == MachineChange::Kind::state) {
        EXPECT_TRUE(follows(state_, change.state)) << name_of(state_) << " to " << name_of(change.state) << at();
        state_ = change.state;
        tell(fmt::format("{}, {} {}", name_of(state_), name_of(session_.status().position.trust),
                         session_.status().trouble_sentence.text));
        ++entered_[static_cast<std::size_t>(state_)];
      } else if (change.kind == MachineChange::Kind::answered) {
        const auto open = open_.find(change.ticket);
        ASSERT_NE(open, open_.end()) << "ticket " << change.ticket << " was not open" << at();
        tell(fmt::format("answered {}: {}, {}", names[open->second.kind], static_cast<int>(change.outcome),
                         change.fault ? change.fault->code() : ""));
        ++outcomes_[open->second.kind][static_cast<std::size_t>(change.outcome)];
        if (open->second.kind == index_of<request::Home>() && change.outcome == passo::Outcome::done) mind_homed();
        open_.erase(open);
      } else if (change.kind == MachineChange::Kind::position_lost) {
        tell("position lost");
        ADD_FAILURE() << "counts differ from what was commanded: motor " << session_.mismatch()->motor << " counted "
                      << session_.mismatch()->counted << ", commanded " << session_.mismatch()->commanded << at();
      }
    }
    EXPECT_EQ(state_, session_.state()) << at();
  }
  static bool follows(MachineState from, MachineState to) {
    return std::ranges::any_of(transitions, [&](const Transition& one) { return one.from == from && one.to == to; });
  }

  void expect_answers() {
    for (const auto& [ticket, open] : open_) {
      EXPECT_TRUE(session_.busy()) << "request " << open.kind << " has no answer" << at();
      if (open.kind != index_of<request::Stop>()) continue;
      EXPECT_LT(session_.now() - open.since, longest_stop) << "request " << open.kind << at();
    }
  }

  // --- What must be true of the machine.

  void expect_outputs() const {
    if (row_of(session_.state()).program_has_outputs) return;
    const BoardOutputs outputs = world_.machine.counts().outputs;
    EXPECT_EQ(outputs.switches, 0) << at();
  }

  double steps_a_unit(std::size_t motor) const {
    const AxisDescription& axis = description_.axes[motor];
    return axis.inverted ? -axis.steps_per_unit : axis.steps_per_unit;
  }
  Point true_place() {
    Point place;
    const Truth truth = world_.truth();
    for (std::size_t m = 0; m < description_.axes.size(); ++m) {
      place[description_.axes[m].axis] = truth.positions[m] / steps_a_unit(m);
    }
    return place;
  }
  // A place that somebody has told need not be the true one: what it is wrong by it is wrong by from then on.
  void measure(const Point& place) {
    const Truth truth = world_.truth();
    const MotorSteps told = steps_at(description_, place);
    for (std::size_t m = 0; m < description_.axes.size(); ++m) {
      wrong_by_[m] = truth.positions[m] - static_cast<double>(told[m]);
    }
  }
  void mind_homed() {
    if (std::exchange(fooled_, false)) return measure(session_.status().position.place);
    wrong_by_ = {};
    EXPECT_EQ(session_.status().position.trust, Trust::homed) << at();
  }

  void expect_place() {
    const MachineStatus status = session_.status();
    if (status.position.trust == Trust::unknown) return;
    const Truth truth = world_.truth();
    for (std::size_t m = 0; m < description_.axes.size(); ++m) {
      const AxisDescription& axis = description_.axes[m];
      const double stands = truth.positions[m] - wrong_by_[m];
      if (!session_.busy()) {
        EXPECT_NEAR(stands, steps_a_unit(m) * status.position.place[axis.axis], 0.5 + 1e-6)
            << "motor " << m << ", " << name_of(status.position.trust) << at();
      }
      if (status.activity != ActivityKind::program && status.activity != ActivityKind::jog) continue;
      // From out of the travel, where a probe move or homing ends, it may only go back.
      const double began = status.position.place[axis.axis];
      const double place = stands / steps_a_unit(m);
      EXPECT_GE(place, std::min(axis.travel_low, began) - description_.path_tolerance.value()) << "motor " << m << at();
      EXPECT_LE(place, std::max(axis.travel_high, began) + description_.path_tolerance.value())
          << "motor " << m << at();
    }
  }

  template <class T>
  static std::size_t index_of() {
    return Request(T{}).index();
  }
  std::string at() const {
    return fmt::format("\n  PASSO_SEED={}, at {:.4f} s, turn {}, state {}", random_.seed(), session_.now().value(),
                       turns_, name_of(session_.state()));
  }
  // The last of what has happened, for whoever looks for the cause of a failure.
  void tell(std::string what) {
    if (told_.size() == 60) told_.pop_front();
    told_.push_back(fmt::format("{:.4f} s: {}", session_.now().value(), std::move(what)));
  }
  void print() const {
    for (const std::string& what : told_) {
      if (HasFailure()) fmt::print("{}\n", what);
    }
    fmt::print("{:.2f} virtual hours, {} turns, {} requests, {} refused, {} steps\n", session_.now().value() / 3600,
               turns_, requests_, refused_, world_.limits.steps());
    fmt::print("cuts {}, spoiled {}, presses {}, doors {}, emergency stops {}, limits pressed {}, resets {}; ",
               world_.cuts, world_.spoiled, world_.presses, world_.doors, world_.emergency_stops, world_.limit_presses,
               world_.resets);
    fmt::print("stopped at once {}\n", world_.stops);
    for (std::size_t kind = 0; kind < names.size(); ++kind) {
      const auto& of = outcomes_[kind];
      fmt::print("{}: taken {}, done {}, stopped {}, failed {}\n", names[kind], taken_[kind], of[0], of[1], of[2]);
    }
    for (const StateRow& row : state_rows) {
      fmt::print("{} {}  ", row.name, entered_[static_cast<std::size_t>(row.state)]);
    }
    fmt::print("\n");
  }

  struct Open {
    std::size_t kind = 0;
    Seconds since{0};
  };
  using Count = std::uint64_t;

  // Small, so that homing takes seconds.
  static MachineDescription small_machine() {
    MachineDescription machine = homing_machine("uno");
    for (AxisDescription& axis : machine.axes) {
      axis.travel_low = axis.axis == Axis::z ? -50 : -60;
      axis.travel_high = axis.axis == Axis::z ? 30 : 60;
      axis.home->switch_at = axis.home->toward_high ? axis.travel_high + 0.4 : axis.travel_low - 0.4;
    }
    return machine;
  }

  MachineDescription description_ = small_machine();
  Random random_;
  SoakWorld world_;
  BoardMachineSession session_;
  std::vector<SoakClient> clients_;
  std::array<double, max_motors> wrong_by_{};
  bool fooled_ = false;
  MachineState state_ = MachineState::offline;
  std::map<Ticket, Open> open_;
  std::deque<std::string> told_;
  Count turns_ = 0;
  Count requests_ = 0;
  Count refused_ = 0;
  std::array<Count, std::variant_size_v<Request>> taken_{};
  std::array<std::array<Count, 3>, std::variant_size_v<Request>> outcomes_{};
  std::array<Count, state_count> entered_{};
};

TEST_F(SessionSoak, holds_what_it_promises) {
  const char* const hours = std::getenv("PASSO_SOAK_HOURS");
  const Seconds time(3600 * (hours != nullptr ? std::strtod(hours, nullptr) : 0.05));
  soak(time / 8);
  const long before = most_memory();
  soak(time);
  print();
  EXPECT_LT(most_memory() - before, 16'384) << "kilobytes more than after an eighth of the time";
}

}  // namespace
}  // namespace passo::test
