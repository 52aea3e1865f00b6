// Random programs that switch outputs in motion, and the changes that they order, written down beside them: an oracle
// that shares no code with the pipeline.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "kit/example_machine.hpp"
#include "kit/stage_test.hpp"
#include "kit/step_log.hpp"
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "passo/machine/machine_observer.hpp"

namespace passo::test {

inline constexpr double full_s = 1000;

// P0 is off in stops, P1 stays on.
inline MachineDescription laser_machine(const std::string& name) {
  using Pin = DigitalOutputDescription::Pin;
  MachineDescription machine = example_machine(name);
  machine.motion_outputs = {.digital = {DigitalOutputDescription{.pin = Pin::flood},
                                        DigitalOutputDescription{.pin = Pin::mist, .stays_on = true}},
                            .laser = LaserDescription{.maximum_s = full_s}};
  return machine;
}

// What a program orders, written down beside it: the oracle.
struct OrderedOutputs {
  bool first = false;
  bool second = false;
  double s = 0;  // of a beam that is on
  friend bool operator==(const OrderedOutputs&, const OrderedOutputs&) = default;
};
inline OrderedOutputs ordered_by(const BoardOutputs& outputs) {
  const bool on = (outputs.switches & 1U) != 0;
  return {.first = (outputs.switches & 8U) != 0,
          .second = (outputs.switches & 4U) != 0,
          .s = on ? std::round(outputs.spindle_rpm * full_s / 24'000) : 0};
}
inline std::string to_text(const OrderedOutputs& state) {
  return fmt::format("{}{} S{}", state.first ? "P0" : "--", state.second ? "P1" : "--", state.s);
}

struct OutputsChange {
  OrderedOutputs to;
  double x = 0;  // where
  double y = 0;
};

struct OutputProgram {
  std::string text;
  std::vector<OutputsChange> changes;
};

// Lines, arcs and rapids with changes of the outputs between them, and dwells.
class OutputProgramWriter {
 public:
  OutputProgramWriter(Random& random, double tolerance) : random_(random), tolerance_(tolerance) {}

  OutputProgram write(int moves) {
    line(tolerance_ > 0 ? fmt::format("G21 G90 G64 P{:.3f} M3 F{}", tolerance_, feed())
                        : fmt::format("G21 G90 G61 M3 F{}", feed()));
    for (int i = 0; i < moves; ++i) {
      change_something();
      if (random_.chance(0.05)) dwell();
      if (random_.chance(0.1)) line(fmt::format("F{}", feed()));
      move();
    }
    become({});
    line("M2");
    return std::move(program_);
  }

 private:
  int feed() { return static_cast<int>(random_.between(300, 5000)); }
  void line(const std::string& text) { program_.text += text + "\n"; }
  void become(const OrderedOutputs& state) {
    if (state == (program_.changes.empty() ? OrderedOutputs{} : program_.changes.back().to)) return;
    program_.changes.push_back({.to = state, .x = x_, .y = y_});
  }
  void change_something() {
    if (random_.chance(0.6)) {
      s_ = random_.chance(0.2) ? 0 : std::floor(random_.between(1, full_s + 1));
      line(fmt::format("S{}", s_));
    }
    if (random_.chance(0.2)) {
      next_.first = random_.chance(0.5);
      line(next_.first ? "M62 P0" : "M63 P0");
    }
    if (random_.chance(0.2)) {
      next_.second = now_.second = random_.chance(0.5);
      line(next_.second ? "M64 P1" : "M65 P1");
    }
  }
  void dwell() {
    line("G4 P0.02");
    become(now_);
  }
  void move() {
    now_ = next_;
    const bool rapid = random_.chance(0.1);
    OrderedOutputs during = now_;
    during.s = rapid ? 0 : s_;
    become(during);
    const bool goes_on = random_.chance(0.4);
    const double length = random_.between(0.4, 3);
    if (!goes_on) angle_ += random_.between(-2.5, 2.5);
    const double x = std::clamp(x_ + length * std::cos(angle_), -60.0, 60.0);
    const double y = std::clamp(y_ + length * std::sin(angle_), -60.0, 60.0);
    if (!rapid && random_.chance(0.2)) {
      line(fmt::format("G2 X{:.4f} Y{:.4f} R{:.4f}", x, y, 3.0));
    } else {
      line(fmt::format("{} X{:.4f} Y{:.4f}", rapid ? "G0" : "G1", x, y));
    }
    x_ = x;
    y_ = y;
  }

  Random& random_;
  double tolerance_;
  OutputProgram program_;
  OrderedOutputs now_;
  OrderedOutputs next_;
  double s_ = 0;
  double x_ = 0;
  double y_ = 0;
  double angle_ = 0;
};

// The steps of a run with the outputs at each, and the changes of the outputs.
class MotionOutputLog final : public MachineObserver {
 public:
  explicit MotionOutputLog(const MachineDescription& machine) : machine_(machine) {}

  void on_steps(Ticks /*time*/, std::uint8_t stepped, std::uint8_t directions) override {
    for (unsigned m = 0; m < StepLog::motors; ++m) {
      if ((stepped >> m & 1U) == 0) continue;
      place_[m] += (directions >> m & 1U) != 0 ? -1 : 1;
      steps[m].emplace_back((directions >> m & 1U) != 0, now_);
    }
  }
  void on_outputs(Ticks /*time*/, const BoardOutputs& outputs) override {
    const OrderedOutputs state = ordered_by(outputs);
    if (state == now_) return;
    now_ = state;
    changes.push_back({.to = state, .x = at(0), .y = at(1)});
  }

  std::array<std::vector<std::pair<bool, OrderedOutputs>>, StepLog::motors> steps;
  std::vector<OutputsChange> changes;

 private:
  double at(unsigned motor) const {
    const AxisDescription& axis = machine_.axes[motor];
    return static_cast<double>(place_[motor]) / (axis.inverted ? -axis.steps_per_unit : axis.steps_per_unit);
  }

  const MachineDescription& machine_;
  std::array<std::int64_t, StepLog::motors> place_{};
  OrderedOutputs now_;
};

// At each stop the beam is off, also for an instant in a corner that is not rounded. Such changes are left out: what
// counts is where the outputs change that hold in motion.
inline std::vector<OutputsChange> without_stops(const std::vector<OutputsChange>& changes, double beside) {
  std::vector<OutputsChange> kept;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const OutputsChange& one = changes[i];
    const bool is_stop = one.to.s == 0 && i + 1 < changes.size() &&
                         std::hypot(changes[i + 1].x - one.x, changes[i + 1].y - one.y) <= beside;
    const OrderedOutputs before = kept.empty() ? OrderedOutputs{} : kept.back().to;
    if (!is_stop && one.to != before) kept.push_back(one);
  }
  return kept;
}

// Each change in its order, within `beside` of its position, and nothing else.
inline void expect_changes(const std::vector<OutputsChange>& all_made, const std::vector<OutputsChange>& all_ordered,
                           double beside) {
  const std::vector<OutputsChange> made = without_stops(all_made, beside);
  const std::vector<OutputsChange> ordered = without_stops(all_ordered, beside);
  for (std::size_t i = 0; i < std::max(made.size(), ordered.size()); ++i) {
    ASSERT_LT(i, made.size()) << "lost: " << to_text(ordered[i].to);
    ASSERT_LT(i, ordered.size()) << "nobody ordered: " << to_text(made[i].to);
    ASSERT_EQ(made[i].to, ordered[i].to) << "change " << i << ": " << to_text(made[i].to) << " instead of "
                                         << to_text(ordered[i].to);
    const double off = std::hypot(made[i].x - ordered[i].x, made[i].y - ordered[i].y);
    ASSERT_LE(off, beside) << "change " << i << " to " << to_text(made[i].to) << " at X" << made[i].x << " Y"
                           << made[i].y << " instead of X" << ordered[i].x << " Y" << ordered[i].y;
  }
}

// The same steps under the same outputs. Beside a change, a step may lie on the other side of it: exact times make
// other events than those of a small board.
inline void expect_same_steps(const MotionOutputLog& run, const MotionOutputLog& reference) {
  constexpr std::size_t beside = 2;
  for (unsigned m = 0; m < StepLog::motors; ++m) {
    const auto& steps = run.steps[m];
    const auto& wanted = reference.steps[m];
    ASSERT_EQ(steps.size(), wanted.size()) << "motor " << m;
    int dark = 0;  // steps in a row
    for (std::size_t i = 0; i < steps.size(); ++i) {
      ASSERT_EQ(steps[i].first, wanted[i].first) << "motor " << m << " step " << i;
      // With the last step of a stop the beam is off, and on a small board a step may be an event late.
      OrderedOutputs stopped = wanted[i].second;
      stopped.s = 0;
      dark = steps[i].second == stopped && stopped != wanted[i].second ? dark + 1 : 0;
      bool found = dark == 1 || dark == 2;
      for (std::size_t k = i - std::min(i, beside); !found && k <= i + beside && k < wanted.size(); ++k) {
        found = steps[i].second == wanted[k].second;
      }
      ASSERT_TRUE(found) << "motor " << m << " step " << i << " of " << steps.size() << " under "
                         << to_text(steps[i].second) << " instead of " << to_text(wanted[i].second);
    }
  }
}

}  // namespace passo::test
