// Matched rows: two profiles as equally long lists of points that a straight wire reaches simultaneously. Private to
// cam/.
#pragma once

#include <cstddef>
#include <vector>

#include "flat_vector.hpp"

#include "passo/cam/wire_cut.hpp"

namespace passo {

struct MatchedRows {
  std::vector<FlatVector> left = {};  // nm
  std::vector<FlatVector> right = {};
  std::vector<std::size_t> marks = {};  // indices of the section boundaries; the first is 0
};

// Matches two profiles. Closed profiles begin and end at their point of maximum X, and are counterclockwise. Empty if
// one of them has zero length.
MatchedRows match_rows(const WireProfile& left, const WireProfile& right, Nanometres tolerance);

}  // namespace passo
