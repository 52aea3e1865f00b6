#include "svg_clip.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "passo/base/trimmed.hpp"
#include "passo/cam/edge_loops.hpp"

namespace passo {
namespace {

constexpr Nanometres clip_chords{1000};
constexpr Nanometres clip_slack{10'000};

DrawnRing ring_of(const DrawnHole& hole) {
  const Nanometres radius{hole.diameter.count / 2};
  return chords_of_path({{{hole.at.x + radius, hole.at.y}, 1}, {{hole.at.x - radius, hole.at.y}, 1}}, true,
                        clip_chords);
}

std::vector<DrawnRing> closed_rings_of(const SvgFigure& figure, bool closes_all) {
  std::vector<DrawnRing> rings;
  for (const DrawnPath& path : figure.paths) {
    if (path.is_closed || closes_all) rings.push_back(chords_of_path(path.points, path.is_closed, clip_chords));
  }
  for (const DrawnHole& hole : figure.holes) rings.push_back(ring_of(hole));
  return rings;
}

double length_nm(const std::vector<DrawnRing>& ways) {
  double length = 0;
  for (const DrawnRing& way : ways) {
    for (std::size_t i = 1; i < way.size(); ++i) length += distance_nm(way[i - 1], way[i]);
  }
  return length;
}

std::vector<PathPoint> points_of(const DrawnRing& ring) {
  std::vector<PathPoint> points;
  points.reserve(ring.size());
  for (const DrawnPoint& point : ring) points.push_back({point, 0});
  return points;
}

bool affords(RegionBudget& budget, const std::vector<DrawnRing>& a, const std::vector<DrawnRing>& b) {
  std::vector<const DrawnRing*> all;
  for (const DrawnRing& ring : a) all.push_back(&ring);
  for (const DrawnRing& ring : b) all.push_back(&ring);
  return budget.affords(all);
}

DrawnBox box_around(const std::vector<DrawnRing>& a, const std::vector<DrawnRing>& b) {
  DrawnBox all = box_of(a.empty() ? b.front() : a.front());
  for (const std::vector<DrawnRing>* const some : {&a, &b}) {
    for (const DrawnRing& ring : *some) {
      const DrawnBox box = box_of(ring);
      all.least = {std::min(all.least.x, box.least.x), std::min(all.least.y, box.least.y)};
      all.most = {std::max(all.most.x, box.most.x), std::max(all.most.y, box.most.y)};
    }
  }
  return all;
}

bool meet(const DrawnBox& a, const DrawnBox& b) {
  return a.least.x <= b.most.x && b.least.x <= a.most.x && a.least.y <= b.most.y && b.least.y <= a.most.y;
}

bool is_in(const DrawnBox& a, const DrawnBox& b) {
  return a.least.x >= b.least.x && a.most.x <= b.most.x && a.least.y >= b.least.y && a.most.y <= b.most.y;
}

// A coordinate within the limits of a drawing.
double bounded_mm(double mm) {
  const double most = to_mm(farthest_drawn).value();
  return std::isfinite(mm) ? std::clamp(mm, -most, most) : most;
}

// The pieces of an open path within the clip; the whole path if it lies within the clip.
void add_pieces(DrawnPath path, const SvgClip& clip, std::vector<DrawnPath>& pieces) {
  const std::vector<DrawnRing> way = {chords_of_path(path.points, false, clip_chords)};
  constexpr double rounding = 10;  // nm
  if (length_nm(ways_within(way, clip.wide)) >= length_nm(way) - rounding) {
    pieces.push_back(std::move(path));
    return;
  }
  for (const DrawnRing& piece : ways_within(way, clip.area)) {
    if (piece.size() >= 2) pieces.push_back({.points = points_of(piece), .layer = path.layer, .line = path.line});
  }
}

}  // namespace

std::shared_ptr<const SvgClip> clip_within(const Region& area, const std::shared_ptr<const SvgClip>& outer,
                                           RegionBudget& budget) {
  if (!affords(budget, area.rings, outer ? outer->area.rings : std::vector<DrawnRing>())) return nullptr;
  auto clip = std::make_shared<SvgClip>();
  clip->area = outer ? common(area, outer->area) : area;
  clip->wide = grown(clip->area, clip_slack);
  clip->bounds = bounds(clip->wide);
  if (clip->area.rings.size() == 1) {
    const DrawnRing& ring = clip->area.rings.front();
    const DrawnBox box = box_of(ring);
    clip->is_rectangle =
        ring.size() == 4 && std::ranges::all_of(ring, [&](DrawnPoint at) {
          return (at.x == box.least.x || at.x == box.most.x) && (at.y == box.least.y || at.y == box.most.y);
        });
  }
  return clip;
}

std::vector<DrawnRing> rings_of(const SvgFigure& figure) {
  return closed_rings_of(figure, true);
}

std::optional<Region> area_of(const SvgFigure& figure, FillRule rule, RegionBudget& budget) {
  std::vector<DrawnRing> rings = rings_of(figure);
  if (!budget.affords(rings)) return std::nullopt;
  return filled_together(std::move(rings), rule);
}

Region area_of_view(const SvgView& view, const DxfTransform& transform) {
  const auto corner = [&](double x, double y) {
    return DrawnPoint{to_nanometres(Mm(bounded_mm(transform.x(x, y)))),
                      to_nanometres(Mm(bounded_mm(transform.y(x, y))))};
  };
  return filled({{corner(0, 0), corner(view.width, 0), corner(view.width, view.height), corner(0, view.height)}});
}

std::optional<std::string> svg_link(std::string_view value) {
  constexpr std::string_view blanks = " \t\r\n\f\"'";
  const std::size_t end = value.find(')');
  if (!value.starts_with("url(") || end == std::string_view::npos) return std::nullopt;
  const std::string_view link = trimmed(value.substr(4, end - 4), blanks);
  if (!link.starts_with('#')) return std::nullopt;
  return std::string(link.substr(1));
}

ClippedFigure clipped(SvgFigure figure, const SvgClip& clip, RegionBudget& budget) {
  std::vector<DrawnRing> rings = closed_rings_of(figure, false);
  std::vector<DrawnRing> lines;
  for (const DrawnPath& path : figure.paths) {
    if (!path.is_closed) lines.push_back(chords_of_path(path.points, false, clip_chords));
  }
  if (rings.empty() && lines.empty()) return {{}, true};
  const DrawnBox box = box_around(rings, lines);
  if (!clip.bounds || !meet(box, *clip.bounds)) return {{}, true};
  if (clip.is_rectangle && is_in(box, *clip.bounds)) return {std::move(figure), true};
  std::vector<DrawnRing> drawn = rings;
  drawn.insert(drawn.end(), lines.begin(), lines.end());
  if (!affords(budget, drawn, clip.wide.rings)) return {{}, false};
  SvgFigure inside;
  const Region area = filled_together(std::move(rings), FillRule::even_odd);
  const bool is_whole = subtracted(area, clip.wide).empty();
  if (is_whole) {
    inside.holes = std::move(figure.holes);
  } else {
    const std::uint32_t layer = figure.paths.empty() ? figure.holes.front().layer : figure.paths.front().layer;
    const std::uint32_t line = figure.paths.empty() ? figure.holes.front().line : figure.paths.front().line;
    for (const DrawnRing& ring : common(area, clip.area).rings) {
      inside.paths.push_back({.points = points_of(ring), .is_closed = true, .layer = layer, .line = line});
    }
  }
  for (DrawnPath& path : figure.paths) {
    if (!path.is_closed) {
      add_pieces(std::move(path), clip, inside.paths);
    } else if (is_whole) {
      inside.paths.push_back(std::move(path));
    }
  }
  return {std::move(inside), true};
}

}  // namespace passo
