#include "passo/pendant/handwheel_reports.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace passo {
namespace {

constexpr unsigned axis_bits = 0x0F;
constexpr unsigned no_axis = 0;
constexpr unsigned scale_shift = 4;
constexpr unsigned scale_bits = 3;
constexpr unsigned no_step = 3;  // both scales are selected, or they change
constexpr int most_detents = 127;

constexpr std::int32_t difference(std::uint32_t a, std::uint32_t b) {
  return static_cast<std::int32_t>(a - b);
}

}  // namespace

PendantTable handwheel_table(const HandwheelDescription& wheel) {
  PendantTable table;
  table.name = "Handwheel";
  table.length = 3;
  table.wheel = PendantTable::Wheel{.byte = 0, .is_reversed = wheel.is_reversed};
  table.axis_selector = PendantTable::AxisSelector{.byte = 1, .positions = {}};
  for (std::size_t i = 0; i < wheel.axes.size(); ++i) {
    if (wheel.axes[i]) table.axis_selector->positions.push_back({1U << i, *wheel.axes[i]});
  }
  table.step_byte = 2;
  for (unsigned scale = 0; scale < no_step; ++scale) {
    table.steps.push_back({.value = scale, .step = wheel.step * std::pow(10.0, scale), .share = wheel.share});
  }
  table.step_share = wheel.share;
  return table;
}

std::vector<std::uint8_t> HandwheelReports::next(const HandwheelCount& reading) {
  const bool is_settled = last_ && last_->selected == reading.selected;
  const int detents = take_detents(reading, is_settled);
  last_ = reading;
  const unsigned axis = is_settled ? reading.selected & axis_bits : no_axis;
  const unsigned scale = is_settled ? reading.selected >> scale_shift & scale_bits : no_step;
  return {static_cast<std::uint8_t>(detents), static_cast<std::uint8_t>(axis), static_cast<std::uint8_t>(scale)};
}

int HandwheelReports::take_detents(const HandwheelCount& reading, bool counts) {
  const bool is_plausible = last_ && std::abs(difference(reading.count, last_->count)) <= most_edges;
  if (!is_plausible) {
    detent_at_ = reading.count;
    return 0;
  }
  const int detents = difference(reading.count, detent_at_) / counts_per_detent_;
  detent_at_ += static_cast<std::uint32_t>(detents * counts_per_detent_);
  return counts ? std::clamp(detents, -most_detents, most_detents) : 0;
}

}  // namespace passo
