// SvgClip: the area to which clip paths and nested views restrict a drawing. Private to cam/.
#pragma once

#include <memory>
#include <optional>

#include "region_budget.hpp"
#include "svg_figure.hpp"

#include "passo/cam/region.hpp"

namespace passo {

struct SvgClip {
  Region area;
  Region wide;                     // the area and 10 µm around it: what lies in it is drawn whole
  std::optional<DrawnBox> bounds;  // of `wide`; nothing if it is empty
  bool is_rectangle = false;       // the area is the upright rectangle of its bounds
};

// Creates the clip of an area within an outer clip, which may be null. Returns null if the budget does not suffice.
std::shared_ptr<const SvgClip> clip_within(const Region& area, const std::shared_ptr<const SvgClip>& outer,
                                           RegionBudget& budget);

// Returns the lines of the figure as rings of chords. Open paths are closed by a line.
std::vector<DrawnRing> rings_of(const SvgFigure& figure);
// Returns the area that the figure encloses; nothing if the budget does not suffice.
std::optional<Region> area_of(const SvgFigure& figure, FillRule rule, RegionBudget& budget);
// Returns the area of a view. Its corners are bounded by the limits of a drawing.
Region area_of_view(const SvgView& view, const DxfTransform& transform);
// Returns the id in "url(#id)".
std::optional<std::string> svg_link(std::string_view value);

struct ClippedFigure {
  SvgFigure figure;
  bool is_affordable = true;  // false: the budget did not suffice
};
// Returns the part of the figure within the clip: of closed lines a part of their area, of open lines pieces. A figure
// that lies completely within the clip is not changed; otherwise its arcs become chords.
ClippedFigure clipped(SvgFigure figure, const SvgClip& clip, RegionBudget& budget);

}  // namespace passo
