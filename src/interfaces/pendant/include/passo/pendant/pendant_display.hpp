// display_reports: the bytes with which a pendant's display shows the state of the machine.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "passo/geometry/axes.hpp"
#include "passo/pendant/pendant_table.hpp"

namespace passo {

struct PendantView {
  Point place;  // in work coordinates, or in machine coordinates
  bool is_machine_place = false;
  std::optional<Axis> axis = {};  // the selected one: the display shows X, Y, Z or A, B, C
  bool is_continuous = false;
  double feed = 0;     // mm/min
  double spindle = 0;  // rpm
  friend bool operator==(const PendantView&, const PendantView&) = default;
};

// Empty: the pendant has no display. Each report begins with its id.
std::vector<std::vector<std::uint8_t>> display_reports(const PendantTable& table, const PendantView& view);

}  // namespace passo
