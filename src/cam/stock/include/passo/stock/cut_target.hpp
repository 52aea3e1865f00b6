// CutTarget: what a program should leave, at the cells of a height field, and how precisely the cut is known.
//
// A height field knows the stock at the centres of its cells. A rib or a tip may stand between the centres. So the
// target also has the highest point of each cell, and a gouge is measured with the greatest height that the stock can
// have in the cell (`at_most`): the height after a cut with thinner tools. If a tool that is thinner by half the
// diagonal of a cell reaches the centre, the tool itself has swept the cell.
#pragma once

#include <optional>
#include <vector>

#include "passo/geometry/cutter.hpp"
#include "passo/geometry/surface.hpp"
#include "passo/stock/height_field.hpp"

namespace passo {

struct CutTarget {
  HeightField low;                          // at the centres of the cells
  HeightField high;                         // the highest point in each cell
  std::optional<HeightField> at_most = {};  // the highest that the stock may be in each cell after the cut
  std::vector<bool> is_beside = {};         // cells without a target, which are not compared; empty: all are
};

// The target is known at the centres only, e.g. as the result of another program.
CutTarget target_of(const HeightField& heights);
// Beside the model the target is the bottom of the field.
CutTarget target_of(const std::vector<SurfaceTriangle>& faces, const Surface& surface, const HeightField& field);

// Returns a thinner cutter. If its tip is `thinned_tip()` above that of the cutter, it stays within the cutter wherever
// it is moved by at most `by` in X and Y.
Cutter thinned(const Cutter& cutter, Mm by);
Mm thinned_tip(const Cutter& cutter, Mm by);
// Returns how much thinner the tools must be for a cell of this size.
Mm thinner_for(Mm cell);

}  // namespace passo
