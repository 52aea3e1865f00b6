// RouteLink: how the route of a program continues that of the program before it.
//
// Without a link, the tool comes from the park position, is changed there, and returns to it. With one, a tool begins
// where the last one has ended, so that all programs of a board are one route.
#pragma once

#include <optional>

#include "passo/cam/drawing.hpp"

namespace passo {

struct RouteLink {
  std::optional<DrawnPoint> start = {};  // where the program before ended; empty: at the park position
  bool changes_in_place = false;         // tools are changed where the last one ended
  bool ends_in_place = false;            // the program ends there, too

  DrawnPoint from(DrawnPoint park) const { return start.value_or(park); }
  // Where a tool goes after its last cut. Empty: it stays there. `is_last`: of the program's tools.
  std::optional<DrawnPoint> to(DrawnPoint park, bool is_last) const {
    return (is_last ? ends_in_place : changes_in_place) ? std::nullopt : std::optional(park);
  }
};

}  // namespace passo
