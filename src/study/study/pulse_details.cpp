#include "passo/study/pulse_details.hpp"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

namespace passo {
namespace {

using Cells = std::vector<std::string>;

// "3/7", "1 2/7", "2": a number that is not negative, as a person writes it.
std::string mixed(std::int64_t numerator, std::int64_t denominator) {
  const std::int64_t whole = numerator / denominator;
  const std::int64_t rest = numerator % denominator;
  if (rest == 0) return fmt::format("{}", whole);
  return whole == 0 ? fmt::format("{}/{}", rest, denominator) : fmt::format("{} {}/{}", whole, rest, denominator);
}

}  // namespace

PulseDetails::PulseDetails(const Method& method, const StepMove& move, std::int64_t pulses)
    : method_(method), move_(move), pulses_(pulses) {
  for (std::size_t axis = 0; axis < move_.axes(); ++axis) longest_ = std::max(longest_, length(axis));
}

std::int64_t PulseDetails::length(std::size_t axis) const {
  return std::abs(move_.to[axis] - move_.from[axis]);
}

bool PulseDetails::judges_axes() const {
  return method_.name == MethodName::lean || method_.name == MethodName::dda ||
         method_.name == MethodName::listing_shared_variable;
}

std::vector<std::string> PulseDetails::judge_names() const {
  Cells names;
  if (method_.name == MethodName::slope_recalculated) return {"slope", "slope_left"};
  if (method_.name == MethodName::slope_blocks) return {"block", "run"};
  if (method_.name == MethodName::listing_slope_blocks) return {};
  if (method_.name == MethodName::point_comparison || method_.name == MethodName::listing_projection) return {"judge"};
  if (method_.name == MethodName::midpoint) return {"at_midpoint"};
  for (std::size_t axis = 0; axis < move_.axes(); ++axis) {
    names.push_back((judges_axes() ? "sum_" : "ideal_") + axis_name(axis));
  }
  if (judges_axes()) return names;
  for (std::size_t axis = 0; axis < move_.axes(); ++axis) names.push_back("midline_" + axis_name(axis));
  return names;
}

std::vector<std::string> PulseDetails::judge(std::int64_t k, const Place& place,
                                             const std::vector<std::int64_t>& decisions) const {
  Cells cells;
  switch (method_.name) {
    case MethodName::master_slave:
    case MethodName::listing_rounding: return fractions(k, place);
    case MethodName::slope_recalculated: return slopes(place);
    case MethodName::slope_blocks: return block(k);
    case MethodName::listing_slope_blocks: return {};
    case MethodName::listing_shared_variable: return shared_sums(decisions[0]);
    case MethodName::listing_projection:
    case MethodName::point_comparison: return {decisions[0] >= 0 ? "F>=0" : "F<0"};
    case MethodName::midpoint: return {fmt::format("{}", at_midpoint(place, decisions[0]))};
    case MethodName::lean:
      for (std::size_t axis = 0; axis < move_.axes(); ++axis) {
        cells.push_back(fmt::format("{}", decisions[axis] + 2 * length(axis)));
      }
      return cells;
    case MethodName::dda: break;
  }
  // An integrator of a line adds the axis's length, one of an arc the distance of the other axis.
  for (std::size_t axis = 0; axis < move_.axes(); ++axis) {
    const std::int64_t added = move_.arc ? std::abs(place[1 - axis] - move_.arc->centre[1 - axis]) : length(axis);
    cells.push_back(fmt::format("{}", decisions[move_.arc ? 1 + axis : axis] + added));
  }
  return cells;
}

// The one variable of all axes, as each axis in turn finds it.
std::vector<std::string> PulseDetails::shared_sums(std::int64_t decision) const {
  Cells cells;
  for (std::size_t axis = 0; axis < move_.axes(); ++axis) {
    decision += 2 * length(axis);
    cells.push_back(fmt::format("{}", decision));
    if (decision >= 0) decision -= 2 * longest_;
  }
  return cells;
}

// Where the ideal line is after k pulses, and the midlines of the cells in which the axes stand. Both count from the
// start, in the direction of travel.
std::vector<std::string> PulseDetails::fractions(std::int64_t k, const Place& place) const {
  Cells cells;
  for (std::size_t axis = 0; axis < move_.axes(); ++axis) cells.push_back(mixed(k * length(axis), longest_));
  for (std::size_t axis = 0; axis < move_.axes(); ++axis) {
    cells.push_back(mixed(2 * std::abs(place[axis] - move_.from[axis]) + 1, 2));
  }
  return cells;
}

// The slope of the whole line, and of what is still to go: shorter axis over longer axis.
std::vector<std::string> PulseDetails::slopes(const Place& place) const {
  const std::size_t longer = length(0) < length(1) ? 1 : 0;
  const auto left = [&](std::size_t axis) { return static_cast<double>(std::abs(move_.to[axis] - place[axis])); };
  return {fmt::format("{:.3f}", static_cast<double>(length(1 - longer)) / static_cast<double>(longest_)),
          fmt::format("{:.3f}", left(1 - longer) / left(longer))};
}

// The number of the block, and the place of pulse k in its run of equal pulses: "4 of 4".
std::vector<std::string> PulseDetails::block(std::int64_t k) const {
  const std::int64_t height = std::min(length(0), length(1));
  if (height == 0) return {"0", fmt::format("{} of {}", k, longest_)};
  const std::int64_t pulses = longest_ / height;
  const std::int64_t longer = longest_ % height;  // blocks of one plain step more; they come first
  const std::int64_t in_longer = longer * (pulses + 1);
  const bool is_longer = k <= in_longer;
  const std::int64_t size = is_longer ? pulses + 1 : pulses;
  const std::int64_t before = is_longer ? k - 1 : k - 1 - in_longer;
  const std::int64_t number = (is_longer ? 0 : longer) + before / size;
  const std::int64_t in_block = before % size;
  const std::int64_t diagonal = pulses / 2;
  std::string run = "1 of 1";
  if (in_block < diagonal) run = fmt::format("{} of {}", in_block + 1, diagonal);
  if (in_block > diagonal) run = fmt::format("{} of {}", in_block - diagonal, size - 1 - diagonal);
  return {fmt::format("{}", number + 1), run};
}

// What MidpointArc judges: F at the midpoint between the two places in question, less a quarter.
std::int64_t PulseDetails::at_midpoint(const Place& place, std::int64_t deviation) const {
  const std::int64_t x = place[0] - move_.arc->centre[0];
  const std::int64_t y = place[1] - move_.arc->centre[1];
  // In the quadrants with x·y > 0 a counterclockwise arc falls in X. On an axis the other coordinate is zero and rises.
  bool x_falls = (x > 0) == (y > 0);
  if (move_.arc->clockwise) x_falls = !x_falls;
  if (x == 0 || y == 0) x_falls = y == 0;
  const std::int64_t falling = std::abs(x_falls ? x : y);
  const std::int64_t rising = std::abs(x_falls ? y : x);
  return falling > rising ? deviation + 2 * rising + 1 - falling : deviation - 2 * falling + 1 + rising;
}

std::vector<std::string> PulseDetails::end_names() const {
  if (method_.name == MethodName::listing_projection) return {length(0) < length(1) ? "left_y" : "left_x"};
  if (method_.name != MethodName::point_comparison || move_.arc) return {"left"};
  switch (method_.end_judging) {
    case EndJudging::coordinates: return {"left_x", "left_y"};
    case EndJudging::projection: return {length(0) < length(1) ? "left_y" : "left_x"};
    case EndJudging::total: break;
  }
  return {"left"};
}

std::vector<std::string> PulseDetails::end(std::int64_t k, const Place& place) const {
  Cells cells;
  for (const std::string& name : end_names()) {
    std::int64_t left = pulses_ - k;
    if (name == "left_x") left = std::abs(move_.to[0] - place[0]);
    if (name == "left_y") left = std::abs(move_.to[1] - place[1]);
    cells.push_back(fmt::format("{}", left));
  }
  return cells;
}

std::string PulseDetails::feed(Pulse pulse) {
  std::string text;
  for (std::size_t axis = 0; axis < most_axes; ++axis) {
    if ((pulse.steps >> axis & 1) == 0) continue;
    text += ((pulse.directions >> axis & 1) != 0 ? "-" : "+") + axis_name(axis);
  }
  return text.empty() ? "none" : text;
}

}  // namespace passo
