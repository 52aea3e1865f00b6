// Matched rows: two profiles as rows of as many places, which a straight wire reaches together. Private to cam/.
#pragma once

#include <cstddef>
#include <vector>

#include "flat_vector.hpp"

#include "passo/cam/wire_cut.hpp"

namespace passo {

struct MatchedRows {
  std::vector<FlatVector> left = {};  // nm
  std::vector<FlatVector> right = {};
  std::vector<std::size_t> marks = {};  // indices where sections begin and end; the first is 0
};

// Closed profiles begin and end at their place of greatest X, and go counterclockwise. Empty: one of them has no way.
MatchedRows match_rows(const WireProfile& left, const WireProfile& right, Nanometres tolerance);

}  // namespace passo
