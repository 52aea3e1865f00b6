#include "passo/tuning/tuning_run.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "passo/judge/judgement.hpp"

namespace passo {
namespace {

double middle_of(const AxisDescription& axis) {
  return (axis.travel_low + axis.travel_high) / 2;
}

// Half of a stroke: far enough for the velocity, and no longer than a second of motion takes.
double reach_of(const AxisDescription& axis) {
  const double travel = 0.49 * (axis.travel_high - axis.travel_low);
  const double v = axis.velocity.value();
  const double a = axis.acceleration.value();
  const double ramps = v * (v / a + (axis.jerk.value() > 0 ? a / axis.jerk.value() : 0));
  return std::min(travel, (ramps + 0.5 * v) / 2);
}

std::string word(const AxisDescription& axis, double offset) {
  return fmt::format(" {}{:.4f}", letter_of(axis.axis), middle_of(axis) + offset);
}

void add_strokes(std::string& text, const AxisDescription& axis) {
  const double reach = reach_of(axis);
  const double v = axis.velocity.value();
  text += fmt::format("G0{}\nG0{}\n", word(axis, reach), word(axis, -reach));
  for (const double share : {1.0, 0.75, 0.5, 0.25}) {
    text += fmt::format("G1 F{:.3f}{}\nG1{}\n", 60 * share * v, word(axis, share * reach), word(axis, -share * reach));
  }
  // Strokes that are too short for the velocity turn about at full acceleration.
  for (const double share : {0.5, 0.2, 0.05}) {
    for (int i = 0; i < 3; ++i) {
      text += fmt::format("G0{}\nG0{}\n", word(axis, share * reach), word(axis, -share * reach));
    }
  }
  text += fmt::format("G0{}\nG4 P0.1\n", word(axis, 0));
}

// A motor's steps wait for the events of a faster one. How late they come depends on the slant and on the speed.
void add_slants(std::string& text, const AxisDescription& one, const AxisDescription& other) {
  const double reach = std::min(reach_of(one), reach_of(other));
  for (const double slant : {0.87, 0.618, 0.3}) {
    const double most = std::min(one.velocity.value(), other.velocity.value() / slant);
    for (const double share : {1.0, 0.85}) {
      const double feed = 60 * share * most * std::hypot(1, slant);
      text += fmt::format("G1 F{:.3f}{}{}\nG1{}{}\n", feed, word(one, reach), word(other, slant * reach),
                          word(one, -reach), word(other, -slant * reach));
    }
  }
}

void add_circles(std::string& text, const AxisDescription& x, const AxisDescription& y) {
  const double v = std::min(x.velocity, y.velocity).value();
  const double a = std::min(x.acceleration, y.acceleration).value();
  const double most = std::min(reach_of(x), reach_of(y));
  for (const double share : {1.0, 0.2}) {
    const double radius = std::max(share * std::min(most, v * v / a), 0.01);
    text += fmt::format("G0{}{}\nG2{}{} I{:.4f} J0 F{:.3f}\n", word(x, radius), word(y, 0), word(x, radius), word(y, 0),
                        -radius, 60 * v);
  }
}

const AxisDescription* axis_of(const MachineDescription& machine, Axis axis) {
  const auto found = std::ranges::find(machine.axes, axis, &AxisDescription::axis);
  return found == machine.axes.end() ? nullptr : &*found;
}

void apply(const AxisTuning& tuning, MachineDescription& machine) {
  AxisDescription& axis = *std::ranges::find(machine.axes, tuning.axis, &AxisDescription::axis);
  axis.velocity = tuning.velocity;
  axis.acceleration = tuning.acceleration;
  axis.jerk = tuning.jerk;
  axis.start_stop = std::min(axis.start_stop, tuning.velocity);
  if (!axis.home) return;
  axis.home->seek = std::min(axis.home->seek, tuning.velocity);
  axis.home->latch = std::min(axis.home->latch, axis.home->seek);
}

MarginVerdict judged(const MachineDescription& machine, const std::string& program) {
  const ProgramReader reader = ProgramReader::from_text("tuning.ngc", program);
  InterpreterOptions options;
  for (const AxisDescription& axis : machine.axes) options.start[axis.axis] = middle_of(axis);
  Diagnostics findings;
  const ProgramCheck check = check_program(reader.again(), machine, options, findings);
  return judge(reader.again(), machine, options, check).margin;
}

// Asks for less of the axis. False: the axis is content.
bool yield_to(const MarginVerdict& verdict, const AxisTuning& tuning, TuningWish& wish) {
  const auto judged = std::ranges::find(verdict.axes, tuning.axis, &AxisMargin::axis);
  if (judged == verdict.axes.end() || !judged->worst || judged->worst->verdict == Verdict::safe) return false;
  constexpr double less = 0.9;
  if (judged->worst->want == LossCause::calm) {
    wish.fastest = less * std::min(judged->worst->speed, tuning.velocity);
  } else {
    wish.margin = 1 - less * (1 - wish.margin);
  }
  return true;
}

}  // namespace

std::string tuning_program(const MachineDescription& machine, const std::vector<Axis>& axes) {
  std::string text = "G21 G90 G17\n";
  std::string high = "G0";
  std::string low = "G0";
  std::string middle = "G0";
  for (const Axis name : axes) {
    const AxisDescription& axis = *axis_of(machine, name);
    add_strokes(text, axis);
    high += word(axis, reach_of(axis));
    low += word(axis, -reach_of(axis));
    middle += word(axis, 0);
  }
  if (axes.size() > 1) text += fmt::format("{}\n{}\n{}\n", high, low, middle);
  for (std::size_t i = 0; i + 1 < axes.size(); ++i) {
    add_slants(text, *axis_of(machine, axes[i]), *axis_of(machine, axes[i + 1]));
    add_slants(text, *axis_of(machine, axes[i + 1]), *axis_of(machine, axes[i]));
  }
  const auto has = [&](Axis axis) { return std::ranges::find(axes, axis) != axes.end(); };
  if (has(Axis::x) && has(Axis::y)) add_circles(text, *axis_of(machine, Axis::x), *axis_of(machine, Axis::y));
  return text + "M2\n";
}

Result<TunedMachine, TuningRefusal> tuned(const MachineDescription& machine, const TuningRequest& request) {
  constexpr int most_rounds = 12;
  std::vector<AxisTuner> tuners;
  std::vector<TuningWish> wishes(request.axes.size(), request.wish);
  std::vector<bool> is_due(request.axes.size(), true);
  TunedMachine result{.machine = machine, .axes = {}, .program = ""};
  for (std::size_t i = 0; i < request.axes.size(); ++i) {
    const AxisDescription& axis = *axis_of(machine, request.axes[i]);
    tuners.push_back(*AxisTuner::of(axis, machine.board));
    if (request.keep_velocity) wishes[i].fastest = axis.velocity;
  }
  result.axes.resize(request.axes.size());
  for (int round = 0; round < most_rounds; ++round) {
    for (std::size_t i = 0; i < tuners.size(); ++i) {
      if (!is_due[i]) continue;
      auto tuning = tuners[i].propose(wishes[i]);
      if (!tuning) {
        return Failure{TuningRefusal{fmt::format("axis {}: {}", letter_of(request.axes[i]), tuning.error().message)}};
      }
      apply(*tuning, result.machine);
      result.axes[i] = std::move(*tuning);
    }
    result.program = tuning_program(result.machine, request.axes);
    const MarginVerdict verdict = judged(result.machine, result.program);
    result.verdict = verdict.verdict;
    if (verdict.verdict == Verdict::safe) break;
    for (std::size_t i = 0; i < tuners.size(); ++i) is_due[i] = yield_to(verdict, result.axes[i], wishes[i]);
  }
  return result;
}

}  // namespace passo
