// shorten_piece_order: shortens the travel from a start through all pieces to an end. A piece need not end where it
// begins. Private to cam/.
//
// It reverses parts of the order (2-opt) and moves up to three pieces elsewhere (Or-opt), as long as this makes the
// travel shorter. A piece that may not be reversed keeps its direction. The number of steps is limited, not the time,
// so equal input gives equal output.
//
// Source: J. L. Bentley, Fast algorithms for geometric traveling salesman problems (1992).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "passo/cam/drawing.hpp"

namespace passo {

struct RoutePiece {
  DrawnPoint start = {};
  DrawnPoint end = {};
  bool may_be_turned = false;
};

struct PlacedPiece {
  std::uint32_t piece = 0;  // index of the piece
  bool is_turned = false;
};

// Begins with the given order. `end`: empty: the travel ends after any of the pieces. `steps`: the maximum number of
// comparisons.
std::vector<PlacedPiece> shorten_piece_order(const std::vector<RoutePiece>& pieces, DrawnPoint start,
                                             std::optional<DrawnPoint> end, std::uint64_t steps);

}  // namespace passo
