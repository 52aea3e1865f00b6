#include "passo/judge/proposals.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "passo/activity/stage_options.hpp"
#include "passo/interpreter/operation.hpp"
#include "passo/interpreter/saved_offsets.hpp"
#include "passo/path/path_builder.hpp"

namespace passo {
namespace {

constexpr double slack = 1e-6;  // as of the check of the travel
constexpr std::string_view unknown_tool = "gcode.unknown-tool";

int zero_parameter(int system, Axis axis) {
  return work_offset_parameter(system) + static_cast<int>(index_of(axis));
}

// Of a parameter: lengths are in the machine's units, angles in degrees.
double unit_of_parameter(const InterpreterOptions& options, Axis axis) {
  return options.machine_units == LengthUnits::inch && !is_rotary(axis) ? mm_per_inch : 1;
}

double zero_of(const InterpreterOptions& options, int system, Axis axis) {
  return saved_value(options.parameters, zero_parameter(system, axis)) * unit_of_parameter(options, axis);
}

void set_zero(InterpreterOptions& options, int system, Axis axis, double zero) {
  options.parameters[zero_parameter(system, axis)] = zero / unit_of_parameter(options, axis);
}

bool has(const Diagnostics& findings, Severity severity, std::string_view code) {
  return std::ranges::any_of(findings.all(),
                             [&](const Diagnostic& one) { return one.severity == severity && one.code == code; });
}

bool leaves_travel(const Diagnostics& findings) {
  return has(findings, Severity::error, travel_exceeded);
}

struct Span {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  bool any() const { return low <= high; }
  void add(double from, double to) {
    low = std::min(low, from);
    high = std::max(high, to);
  }
};

// How far the program goes in machine coordinates in each work coordinate system, of the places that follow the
// system's zero. They are found by playing the program twice, with zeros that differ by a little: G53, and the zeros
// that the program sets itself, follow none.
class ZeroFollower {
 public:
  using Spans = std::array<PerAxis<Span>, work_systems + 1>;

  explicit ZeroFollower(const Unfit& unfit) : machine_(unfit.machine), moved_options_(unfit.options) {
    constexpr double endless_travel = 1e9;
    for (AxisDescription& axis : machine_.axes) {
      axis.travel_low = -endless_travel;
      axis.travel_high = endless_travel;
      for (int system = 1; system <= work_systems; ++system) {
        set_zero(moved_options_, system, axis.axis, zero_of(unfit.options, system, axis.axis) + shift);
      }
    }
    Diagnostics unheard;
    Diagnostics unheard_too;
    ProgramChecker here(unfit.program.again(), machine_, unfit.options, unheard);
    ProgramChecker moved(unfit.program.again(), machine_, moved_options_, unheard_too);
    std::optional<Segment> segment;
    std::optional<Segment> other;
    here.watch([&](const PathItem& item) { segment = segment_of(item); });
    moved.watch([&](const PathItem& item) { other = segment_of(item); });
    for (bool done = false; !done;) {
      segment.reset();
      other.reset();
      done = here.go_on(1);
      if (moved.go_on(1) != done || segment.has_value() != other.has_value()) return;  // another way
      if (segment) add(*segment, *other, here.frame().work_system());
    }
    known_ = true;
  }

  // Whether the program goes the same way with both zeros.
  bool known() const { return known_; }
  const Spans& spans() const { return spans_; }

 private:
  static constexpr double shift = 0.25;

  static std::optional<Segment> segment_of(const PathItem& item) {
    const auto* const segment = std::get_if<Segment>(&item);
    return segment != nullptr ? std::optional(*segment) : std::nullopt;
  }
  void add(const Segment& segment, const Segment& moved, int system) {
    const Curve& curve = segment.curve;
    // A line begins where something else has ended.
    const bool is_line = curve.shape() == Curve::Shape::line;
    const Box box = is_line ? Box{curve.end(), curve.end()} : curve.extents();
    for (const AxisDescription& axis : machine_.axes) {
      const Axis one = axis.axis;
      if (std::abs(moved.curve.end()[one] - curve.end()[one] - shift) > slack) continue;
      spans_[static_cast<std::size_t>(system)][one].add(box.low[one], box.high[one]);
    }
  }

  MachineDescription machine_;
  InterpreterOptions moved_options_;
  Spans spans_;
  bool known_ = false;
};

// The least shift that brings the span into the travel: in whole millimetres if there is room for that, else in
// thousandths.
double shift_into(const Span& span, double low, double high) {
  const double least = span.low < low - slack ? low - span.low : span.high > high + slack ? high - span.high : 0;
  for (const double grid : {1.0, 0.001}) {
    const double shift = std::copysign(std::ceil(std::abs(least) / grid - slack) * grid, least);
    if (span.low + shift >= low - slack && span.high + shift <= high + slack) return shift;
  }
  return least;
}

// What is told is what is checked.
double rounded(double zero) {
  constexpr double parts_of_mm = 1e4;
  return std::round(zero * parts_of_mm) / parts_of_mm + 0.0;  // no -0
}

// For a program that leaves the travel. Nothing where another work zero does not help, as for G53.
std::vector<Proposal> proposals_for_travel(const Unfit& unfit, const Diagnostics& findings) {
  if (!leaves_travel(findings)) return {};
  const ZeroFollower follower(unfit);
  if (!follower.known()) return {};
  std::vector<Proposal> short_axes;
  InterpreterOptions options = unfit.options;
  proposal::WorkZeros zeros;
  for (int system = 1; system <= work_systems; ++system) {
    for (const AxisDescription& axis : unfit.machine.axes) {
      const Span& span = follower.spans()[static_cast<std::size_t>(system)][axis.axis];
      if (!span.any()) continue;
      const double needed = span.high - span.low;
      const double travel = axis.travel_high - axis.travel_low;
      if (needed > travel + slack) {
        short_axes.push_back(proposal::AxisTooShort{.axis = axis.axis, .needed = needed, .travel = travel});
        continue;
      }
      const double shift = shift_into(span, axis.travel_low, axis.travel_high);
      if (shift == 0) continue;
      const double zero = rounded(zero_of(unfit.options, system, axis.axis) + shift);
      set_zero(options, system, axis.axis, zero);
      zeros.zeros.push_back({.system = system, .axis = axis.axis, .zero = zero});
    }
  }
  if (!short_axes.empty()) return short_axes;
  if (zeros.zeros.empty()) return {};
  Diagnostics then;
  static_cast<void>(check_program(unfit.program.again(), unfit.machine, options, then));
  if (leaves_travel(then) || then.errors() >= findings.errors()) return {};
  return {std::move(zeros)};
}

// For a program without errors whose motors lose steps: see `judged`. Up to five times the time of a check.
std::vector<Proposal> proposals_for_motors(const Unfit& unfit, const ProgramCheck& check, const Judgement& judged) {
  bool feeds = false;
  bool rapids = false;
  for (const MarginSpot& spot : judged.margin.worst) {
    if (spot.verdict != Verdict::safe) (spot.rapid ? rapids : feeds) = true;
  }
  if (!judged.lost() || check.probes || !(feeds || rapids)) return {};
  const auto is_safe_at = [&](int percent) {
    const double factor = percent / 100.0;
    const Judgement slower = judge(unfit.program.again(), unfit.machine, unfit.options, check, {}, {},
                                   {.feed = feeds ? factor : 1, .rapids = rapids ? factor : 1});
    return slower.margin.verdict == Verdict::safe;
  };
  // Slower is nearly always safer, so halving finds the fastest; what it finds was tried in any case.
  int best = 0;
  for (int low = 0, high = 10; high - low > 1;) {
    const int middle = (low + high) / 2;
    const bool safe = is_safe_at(10 * middle);
    if (safe) best = 10 * middle;
    (safe ? low : high) = middle;
  }
  if (best == 0) return {};
  return {proposal::SlowerMotion{.feed_percent = feeds ? best : 100, .rapid_percent = rapids ? best : 100}};
}

std::vector<std::int32_t> unknown_tools(const Diagnostics& findings) {
  std::vector<std::int32_t> tools;
  for (const Diagnostic& one : findings.all()) {
    if (one.severity != Severity::error || one.code != unknown_tool) continue;
    // The word itself, as T3 or D5. What comes of an expression is not proposed.
    const std::size_t at = one.place.column;
    if (at >= one.text.size()) continue;
    const char* const first = one.text.data() + at;
    const char* const end = one.text.data() + std::min(one.text.size(), at + one.place.length - 1);
    std::int32_t number = 0;
    if (const auto read = std::from_chars(first, end, number); read.ec != std::errc() || read.ptr != end) continue;
    if (std::ranges::find(tools, number) == tools.end()) tools.push_back(number);
  }
  return tools;
}

// The highest spindle speed with which no axis of a thread is too fast. Infinite: no move follows the spindle.
class ThreadSpeed {
 public:
  explicit ThreadSpeed(const MachineDescription& machine) : limits_(motion_limits(machine)) {}

  void watch(const PathItem& item) {
    const auto* const segment = std::get_if<Segment>(&item);
    if (segment == nullptr || segment->lock == SpindleLock::none || !(segment->pitch > Mm(0))) return;
    const double fastest_feed = speed_within(segment->curve.steepest(), fastest, limits_);
    highest_ = std::min(highest_, fastest_feed / segment->pitch.value() * seconds_per_minute);
  }
  double revolutions_per_minute() const { return highest_; }

 private:
  MotionLimits limits_;
  double highest_ = std::numeric_limits<double>::infinity();
};

// What a program asks of the spindle.
struct AskedOfSpindle {
  double most = 0;                 // rpm
  bool feeds_by_the_turn = false;  // G95: such feeds are slower by themselves where the spindle is slower
};

AskedOfSpindle asked_of_spindle(const Unfit& unfit) {
  AskedOfSpindle asked;
  Diagnostics unheard;
  static_cast<void>(
      check_program(unfit.program.again(), unfit.machine, unfit.options, unheard, {}, [&](const Operation& operation) {
        if (const auto* speed = std::get_if<operation::SetSpindleSpeed>(&operation.what)) {
          asked.most = std::max(asked.most, speed->revolutions_per_minute);
        } else if (const auto* mode = std::get_if<operation::SetFeedMode>(&operation.what)) {
          asked.feeds_by_the_turn = asked.feeds_by_the_turn || mode->mode == FeedMode::units_per_revolution;
        }
      }));
  return asked;
}

// For a program that calls for tools which are not in the table. Nothing where more than the tools is wrong.
std::vector<Proposal> proposals_for_tools(const Unfit& unfit, const Diagnostics& findings) {
  constexpr int most_rounds = 10;  // a check names so many errors only
  InterpreterOptions options = unfit.options;
  std::vector<std::int32_t> added;
  Diagnostics then;
  std::vector<std::int32_t> missing = unknown_tools(findings);
  for (int round = 0; round < most_rounds && !missing.empty(); ++round) {
    for (const std::int32_t number : missing) {
      if (options.tools.add({.number = number, .pocket = number})) added.push_back(number);
    }
    then.clear();
    static_cast<void>(check_program(unfit.program.again(), unfit.machine, options, then));
    missing = unknown_tools(then);
  }
  if (added.empty() || then.any_error()) return {};
  return {proposal::Tools{.numbers = std::move(added)}};
}

// For a program that an axis cannot follow the spindle in. Nothing where more than that is wrong.
std::vector<Proposal> proposals_for_threads(const Unfit& unfit, const Diagnostics& findings) {
  if (!has(findings, Severity::error, "path.thread-too-fast")) return {};
  ThreadSpeed speed(unfit.machine);
  Diagnostics unheard;
  static_cast<void>(check_program(unfit.program.again(), unfit.machine, unfit.options, unheard,
                                  [&](const PathItem& item) { speed.watch(item); }));
  const double rpm = std::floor(speed.revolutions_per_minute() * (1 + slack));
  if (!(rpm >= 1) || !std::isfinite(rpm)) return {};
  // A spindle that turns no faster does what a smaller S would do.
  MachineDescription slower = unfit.machine;
  slower.tool.highest_rpm = rpm;
  Diagnostics then;
  static_cast<void>(check_program(unfit.program.again(), slower, unfit.options, then));
  if (then.any_error()) return {};
  return {proposal::SpindleForThread{.revolutions_per_minute = rpm}};
}

// For a program without errors that asks for a faster spindle than there is.
std::vector<Proposal> proposals_for_spindle(const Unfit& unfit, const ProgramCheck& check,
                                            const Diagnostics& findings) {
  if (!has(findings, Severity::warning, "path.spindle-too-fast") || check.probes) return {};
  const AskedOfSpindle asked = asked_of_spindle(unfit);
  const double limit = unfit.machine.tool.highest_rpm;
  if (!(limit > 0 && asked.most > limit) || asked.feeds_by_the_turn) return {};
  constexpr int least_override = 10;
  const int percent = static_cast<int>(std::floor(100 * limit / asked.most * (1 + slack)));
  if (percent < least_override) return {};
  const Judgement slower =
      judge(unfit.program.again(), unfit.machine, unfit.options, check, {}, {}, {.feed = percent / 100.0});
  if (slower.lost()) return {};
  return {proposal::SpindleAndFeed{.revolutions_per_minute = limit,
                                   .feed_percent = percent,
                                   .motion = slower.summary.cutting_time + slower.summary.rapid_time}};
}

}  // namespace

std::vector<Proposal> proposals_of(const Unfit& unfit, const ProgramCheck& check, const Diagnostics& findings,
                                   const Judgement* judged) {
  std::vector<Proposal> all;
  const auto add = [&all](std::vector<Proposal> more) { std::ranges::move(more, std::back_inserter(all)); };
  if (!check.good) {
    add(proposals_for_travel(unfit, findings));
    add(proposals_for_tools(unfit, findings));
    add(proposals_for_threads(unfit, findings));
  } else if (judged != nullptr) {
    add(proposals_for_spindle(unfit, check, findings));
    add(proposals_for_motors(unfit, check, *judged));
  }
  return all;
}

}  // namespace passo
