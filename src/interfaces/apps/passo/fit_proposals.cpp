#include "fit_proposals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "passo/interpreter/saved_offsets.hpp"
#include "passo/path/path_builder.hpp"

namespace passo {
namespace {

constexpr double slack = 1e-6;  // as of the check of the travel

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

bool leaves_travel(const Diagnostics& findings) {
  return std::ranges::any_of(findings.all(), [](const Diagnostic& one) {
    return one.severity == Severity::error && one.code == travel_exceeded;
  });
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

// How far the program goes in machine coordinates in each work system, of the places that follow the system's zero.
// They are found by playing the program twice, with zeros that differ by a little: G53, and the zeros that the program
// sets itself, follow none.
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

Proposal too_short(const AxisDescription& axis, const Span& span) {
  const double needed = span.high - span.low;
  const double there = axis.travel_high - axis.travel_low;
  const char* const unit = is_rotary(axis.axis) ? "deg" : "mm";
  const std::string letter(1, letter_of(axis.axis));
  return {.kind = "axis-too-short",
          .words = fmt::format("{0} is too short by {1:.3f} {4}: the program needs {2:.3f} {4}, the travel has {3:.3f}",
                               letter, needed - there, needed, there, unit),
          .values = {{"axis", letter}, {"needed", needed}, {"travel", there}}};
}

}  // namespace

std::vector<Proposal> proposals_for_travel(const Unfit& unfit, const Diagnostics& findings) {
  if (!leaves_travel(findings)) return {};
  const ZeroFollower follower(unfit);
  if (!follower.known()) return {};
  std::vector<Proposal> short_axes;
  InterpreterOptions options = unfit.options;
  std::string words;
  nlohmann::ordered_json zeros = nlohmann::ordered_json::object();
  for (int system = 1; system <= work_systems; ++system) {
    std::string line;
    for (const AxisDescription& axis : unfit.machine.axes) {
      const Span& span = follower.spans()[static_cast<std::size_t>(system)][axis.axis];
      if (!span.any()) continue;
      if (span.high - span.low > axis.travel_high - axis.travel_low + slack) {
        short_axes.push_back(too_short(axis, span));
        continue;
      }
      const double shift = shift_into(span, axis.travel_low, axis.travel_high);
      if (shift == 0) continue;
      const double zero = rounded(zero_of(unfit.options, system, axis.axis) + shift);
      set_zero(options, system, axis.axis, zero);
      line += fmt::format(" {}{:.10g}", letter_of(axis.axis), zero);
      zeros[name_of_system(system)][std::string(1, letter_of(axis.axis))] = zero;
    }
    if (!line.empty()) words += fmt::format("{}G10 L2 P{}{}", words.empty() ? "" : ", ", system, line);
  }
  if (!short_axes.empty()) return short_axes;
  if (words.empty()) return {};
  Diagnostics then;
  static_cast<void>(check_program(unfit.program.again(), unfit.machine, options, then));
  if (leaves_travel(then) || then.errors() >= findings.errors()) return {};
  return {{.kind = "work-zero",
           .words = fmt::format("with another work zero the program fits the travel (checked): G21 {}", words),
           .values = {{"zeros", zeros}}}};
}

std::vector<Proposal> proposals_for_motors(const Unfit& unfit, const ProgramCheck& check, const CheckPage& page) {
  bool feeds = false;
  bool rapids = false;
  for (const MarginSpot& spot : page.margin.worst) {
    if (spot.verdict != Verdict::safe) (spot.rapid ? rapids : feeds) = true;
  }
  if (!page.lost() || check.probes || !(feeds || rapids)) return {};
  const auto is_safe_at = [&](int percent) {
    const double factor = percent / 100.0;
    const CheckPage slower =
        judge(unfit.program.again(), unfit.machine, unfit.options, check, {}, [](double /*share*/) {},
              {.feeds = feeds ? factor : 1, .rapids = rapids ? factor : 1});
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
  const char* const what = feeds && rapids ? "feeds and rapids" : feeds ? "feeds" : "rapids";
  return {{.kind = "override",
           .words = fmt::format("with {} at {} % the motors keep their steps (checked)", what, best),
           .values = {{"feed_percent", feeds ? best : 100}, {"rapid_percent", rapids ? best : 100}}}};
}

std::string to_text(const std::vector<Proposal>& proposals) {
  std::string text;
  for (const Proposal& proposal : proposals) text += fmt::format("proposal        {}\n", proposal.words);
  return text;
}

nlohmann::ordered_json as_json(const std::vector<Proposal>& proposals) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Proposal& proposal : proposals) {
    nlohmann::ordered_json json = {{"kind", proposal.kind}, {"words", proposal.words}};
    json.update(proposal.values);
    list.push_back(json);
  }
  return list;
}

}  // namespace passo
