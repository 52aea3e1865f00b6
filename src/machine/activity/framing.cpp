#include "passo/activity/framing.hpp"

#include <algorithm>
#include <vector>

#include "small_program.hpp"

#include "passo/machine_file/machine_kind.hpp"

namespace passo {
namespace {

using Spot = JobOutline::Spot;

constexpr double farthest = 1e4;  // mm
constexpr FramingField framing_field_rows[] = {
    {"height", &Framing::height, -farthest, farthest,
     "work Z of the moves around the job, mm (default: the clearance height)"},
    {"clearance", &Framing::clearance, -farthest, farthest,
     "work Z of the moves to the job and back, mm (default: the highest Z of the job)"},
    {"feed", &Framing::feed, 1, 1e5, "feed rate around the job, mm/min (default: 2000)"},
};

constexpr SentenceRow wrong_value{"framing.value", "{name}: expected {low} to {high}, not {value}"};
constexpr SentenceRow no_feeds{"framing.no-feeds", "the program has no feed moves, so there is nothing to frame"};
constexpr SentenceRow no_plane{"framing.no-plane", "framing needs the axes X and Y"};

std::optional<Sentence> refuse_values(const Framing& framing) {
  for (const FramingField& field : framing_field_rows) {
    const std::optional<double>& value = framing.*field.value;
    if (!value || (*value >= field.low && *value <= field.high)) continue;
    return wrong_value.with({{"name", std::string(field.name)},
                             {"low", fmt::format("{:g}", field.low)},
                             {"high", fmt::format("{:g}", field.high)},
                             {"value", fmt::format("{:g}", *value)}});
  }
  return {};
}

std::vector<Spot> corners_of(const JobOutline& outline, bool hull) {
  if (hull) return outline.hull();
  const Spot& low = outline.low();
  const Spot& high = outline.high();
  return {low, {high[0], low[1]}, high, {low[0], high[1]}};
}

}  // namespace

std::span<const FramingField> framing_fields() {
  return framing_field_rows;
}

Result<std::string, Sentence> framing_program(const JobOutline& outline, const Framing& framing,
                                              const MachineDescription& machine, std::string_view job) {
  if (auto wrong = refuse_values(framing)) return Failure{std::move(*wrong)};
  if (!has_axis(machine, Axis::x) || !has_axis(machine, Axis::y)) return Failure{no_plane.with()};
  if (outline.empty()) return Failure{no_feeds.with()};
  const double zero = outline.work_zero()[Axis::z];
  const double asked = framing.clearance ? zero + *framing.clearance : outline.top();
  const double height = framing.height ? zero + *framing.height : asked;
  const double clearance = std::max(asked, height);
  for (const double z : {clearance, height}) {
    if (auto outside = outside_travel(machine, Axis::z, z)) return Failure{std::move(*outside)};
  }

  const std::vector<Spot> corners = corners_of(outline, framing.hull);
  const bool has_z = has_axis(machine, Axis::z);
  SmallProgram program(fmt::format("frame of {}: {}", job, framing.hull ? "the convex hull" : "the extents"));
  if (has_z) {
    program.line("o100 if [#<_abs_z> lt {:.4f}]", clearance);
    program.line("  G53 G0 Z{:.4f} (clearance height)", clearance);
    program.line("o100 endif");
  }
  const auto at = [](const Spot& spot) { return fmt::format("X{:.4f} Y{:.4f}", spot[0], spot[1]); };
  program.line("G53 G0 {}", at(corners.front()));
  if (has_z) program.line("G53 G0 Z{:.4f}", height);
  program.line("F{:.6g}", framing.feed.value_or(Framing::usual_feed));
  for (std::size_t i = 1; i <= corners.size(); ++i) program.line("G53 G1 {}", at(corners[i % corners.size()]));
  if (has_z) program.line("G53 G0 Z{:.4f}", clearance);
  return program.finish();
}

}  // namespace passo
