// The only file of cam/ that sees Clipper.
#include "passo/cam/region.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "region_strips.hpp"
#include "ring_groups.hpp"
#include <polyclipping/clipper.hpp>

namespace passo {
namespace {

namespace clipper = ClipperLib;

__extension__ using Wide = __int128;  // sums of products of two lengths

clipper::cInt bounded(Nanometres length) {
  return std::clamp(length.count, -farthest_of_region.count, farthest_of_region.count);
}

clipper::Path path_of(const DrawnRing& ring) {
  clipper::Path path;
  path.reserve(ring.size());
  for (const DrawnPoint& point : ring) path.emplace_back(bounded(point.x), bounded(point.y));
  return path;
}

clipper::Paths paths_of(const std::vector<DrawnRing>& rings) {
  clipper::Paths paths;
  paths.reserve(rings.size());
  for (const DrawnRing& ring : rings) paths.push_back(path_of(ring));
  return paths;
}

DrawnRing ring_of(const clipper::Path& path) {
  DrawnRing ring;
  ring.reserve(path.size());
  for (const clipper::IntPoint& point : path) ring.push_back({{bounded({point.X})}, {bounded({point.Y})}});
  return ring;
}

std::vector<DrawnRing> rings_of(const clipper::Paths& paths) {
  std::vector<DrawnRing> rings;
  rings.reserve(paths.size());
  for (const clipper::Path& path : paths) rings.push_back(ring_of(path));
  return rings;
}

// Twice the area, in square nanometres.
Wide doubled_area(const DrawnRing& ring) {
  Wide sum = 0;
  for (std::size_t i = 0, last = ring.size() - 1; i < ring.size(); last = i++) {
    sum += static_cast<Wide>(ring[last].x.count) * ring[i].y.count -
           static_cast<Wide>(ring[i].x.count) * ring[last].y.count;
  }
  return sum;
}

DrawnBox box_of(const clipper::Path& path) {
  if (path.empty()) return {};
  const auto [left, right] = std::ranges::minmax(path, {}, &clipper::IntPoint::X);
  const auto [low, high] = std::ranges::minmax(path, {}, &clipper::IntPoint::Y);
  return {{{left.X}, {low.Y}}, {{right.X}, {high.Y}}};
}

// What `work` makes of each group of paths that are farther than `reach` from all others.
template <class Work>
Region by_groups(const clipper::Paths& paths, Nanometres reach, const Work& work) {
  Region all;
  std::vector<DrawnBox> boxes;
  for (const clipper::Path& path : paths) boxes.push_back(box_of(path));
  for (const std::vector<std::size_t>& group : groups_apart(boxes, reach)) {
    std::vector<DrawnRing> rings = rings_of(work(group));
    std::ranges::move(rings, std::back_inserter(all.rings));
  }
  return all;
}

constexpr std::size_t corners_of_strip = 4'000;

// What `work` makes of rings, and of others, in strips if there are many. `reach`: how far beyond a strip the rings
// matter in it.
template <class Work>
clipper::Paths in_strips(const std::vector<DrawnRing>& rings, const std::vector<DrawnRing>& others, Nanometres reach,
                         const Work& work) {
  std::vector<DrawnRing> all = rings;
  all.insert(all.end(), others.begin(), others.end());
  const std::vector<RegionStrip> strips = strips_of(all, corners_of_strip, {4 * reach.count});
  if (strips.size() == 1) return work(paths_of(rings), paths_of(others));
  const StripCutter of_rings(rings);
  const StripCutter of_others(others);
  std::vector<DrawnRing> found;
  for (const RegionStrip& strip : strips) {
    // The ends of the others lie elsewhere, so no edges coincide there.
    const RegionStrip around{strip.low - reach, strip.high + reach};
    const RegionStrip farther{strip.low - Nanometres{2 * reach.count}, strip.high + Nanometres{2 * reach.count}};
    const clipper::Paths here = work(paths_of(of_rings.within(around)), paths_of(of_others.within(farther)));
    std::ranges::move(StripCutter(rings_of(here)).within(strip), std::back_inserter(found));
  }
  return paths_of(joined_at_seams(std::move(found), strips));
}

Region combined(clipper::ClipType how, clipper::Paths a, clipper::Paths b) {
  constexpr Nanometres reach{5'000};  // of what the ends of the parts in a strip can disturb
  const std::size_t of_a = a.size();
  std::ranges::move(b, std::back_inserter(a));
  return by_groups(a, {1}, [&](const std::vector<std::size_t>& group) {
    std::vector<DrawnRing> rings;
    std::vector<DrawnRing> others;
    for (const std::size_t i : group) (i < of_a ? rings : others).push_back(ring_of(a[i]));
    return in_strips(rings, others, reach, [how](const clipper::Paths& subjects, const clipper::Paths& clips) {
      clipper::Clipper clip;
      clip.AddPaths(subjects, clipper::ptSubject, true);
      clip.AddPaths(clips, clipper::ptClip, true);
      clipper::Paths found;
      clip.Execute(how, found, clipper::pftNonZero, clipper::pftNonZero);
      return found;
    });
  });
}

// Moves the edges of paths outwards by a distance, all with one arc tolerance.
class Growth {
 public:
  Growth(double distance, Nanometres tolerance) : distance_(distance) {
    // Clipper rounds the number of an arc's chords down by up to a half: a chord may be up to 1.5 times as long as
    // asked for, and then lies 2.25 times as far from the arc.
    constexpr double chords_left_out = 2.25;
    constexpr double least_tolerance = 10;  // nm
    arc_tolerance_ = std::max(least_tolerance, static_cast<double>(tolerance.count)) / chords_left_out;
  }

  clipper::Paths of_way(const DrawnRing& way) const { return grown({path_of(way)}, clipper::etOpenRound); }

  Region of(const std::vector<DrawnRing>& rings) const {
    const Nanometres reach{static_cast<std::int64_t>(2 * std::max(distance_, 0.0)) + 2};
    const Nanometres beyond{static_cast<std::int64_t>(std::abs(distance_)) + 10'000};
    return by_groups(paths_of(rings), reach, [&](const std::vector<std::size_t>& group) {
      std::vector<DrawnRing> near;
      for (const std::size_t i : group) near.push_back(rings[i]);
      return in_strips(near, {}, beyond, [this](const clipper::Paths& paths, const clipper::Paths&) {
        return grown(paths, clipper::etClosedPolygon);
      });
    });
  }

 private:
  clipper::Paths grown(const clipper::Paths& paths, clipper::EndType end) const {
    clipper::ClipperOffset growth;
    growth.ArcTolerance = arc_tolerance_;
    growth.AddPaths(paths, clipper::jtRound, end);
    clipper::Paths found;
    growth.Execute(found, distance_);
    return found;
  }

  double distance_;
  double arc_tolerance_;
};

// Whether the point is inside the ring (1), outside (0) or on its rim (-1).
int place_of(DrawnPoint point, const DrawnRing& ring) {
  bool inside = false;
  for (std::size_t i = 0, last = ring.size() - 1; i < ring.size(); last = i++) {
    const DrawnPoint a = ring[last];
    const DrawnPoint b = ring[i];
    if (std::min(a.y, b.y) > point.y || std::max(a.y, b.y) < point.y) continue;
    const Wide side = static_cast<Wide>(b.x.count - a.x.count) * (point.y.count - a.y.count) -
                      static_cast<Wide>(point.x.count - a.x.count) * (b.y.count - a.y.count);
    if (side == 0 && std::min(a.x, b.x) <= point.x && point.x <= std::max(a.x, b.x)) return -1;
    if ((a.y > point.y) != (b.y > point.y) && (side > 0) == (b.y > a.y)) inside = !inside;
  }
  return inside ? 1 : 0;
}

bool is_within(const DrawnBox& inner, const DrawnBox& outer) {
  return inner.least.x >= outer.least.x && inner.least.y >= outer.least.y && inner.most.x <= outer.most.x &&
         inner.most.y <= outer.most.y;
}

// Whether the ring `hole` lies in the ring `outer`. Rings of a region may touch, and do not cross.
bool lies_in(const DrawnRing& hole, const DrawnRing& outer) {
  for (const DrawnPoint& point : hole) {
    const int place = place_of(point, outer);
    if (place >= 0) return place == 1;
  }
  return true;
}

}  // namespace

DrawnBox box_of(const DrawnRing& ring) {
  DrawnBox box{ring.front(), ring.front()};
  for (const DrawnPoint& point : ring) {
    box.least = {std::min(box.least.x, point.x), std::min(box.least.y, point.y)};
    box.most = {std::max(box.most.x, point.x), std::max(box.most.y, point.y)};
  }
  return box;
}

Region filled(std::vector<DrawnRing> rings) {
  std::erase_if(rings, [](const DrawnRing& ring) { return ring.size() < 3; });
  for (DrawnRing& ring : rings) {
    if (doubled_area(ring) < 0) std::ranges::reverse(ring);
  }
  return combined(clipper::ctUnion, paths_of(rings), {});
}

Region filled_together(std::vector<DrawnRing> rings, FillRule rule) {
  std::erase_if(rings, [](const DrawnRing& ring) { return ring.size() < 3; });
  const clipper::Paths paths = paths_of(rings);
  const clipper::PolyFillType fill = rule == FillRule::even_odd ? clipper::pftEvenOdd : clipper::pftNonZero;
  return by_groups(paths, {1}, [&](const std::vector<std::size_t>& group) {
    clipper::Clipper clip;
    for (const std::size_t i : group) clip.AddPath(paths[i], clipper::ptSubject, true);
    clipper::Paths found;
    clip.Execute(clipper::ctUnion, found, fill, fill);
    return found;
  });
}

Region united(const Region& a, const Region& b) {
  return combined(clipper::ctUnion, paths_of(a.rings), paths_of(b.rings));
}

Region united(const std::vector<Region>& regions) {
  clipper::Paths all;
  for (const Region& region : regions) {
    for (const DrawnRing& ring : region.rings) all.push_back(path_of(ring));
  }
  return combined(clipper::ctUnion, all, {});
}

Region subtracted(const Region& from, const Region& what) {
  return combined(clipper::ctDifference, paths_of(from.rings), paths_of(what.rings));
}

Region common(const Region& a, const Region& b) {
  return combined(clipper::ctIntersection, paths_of(a.rings), paths_of(b.rings));
}

Region grown(const Region& region, Nanometres distance, Nanometres tolerance) {
  if (region.empty() || distance.count == 0) return region;
  return Growth(static_cast<double>(bounded(distance)), tolerance).of(region.rings);
}

Region swept(const std::vector<DrawnRing>& ways, Nanometres radius, Nanometres tolerance) {
  if (radius.count <= 0) return {};
  // Each way on its own: where it turns, its rims cross themselves, and a sweep over all ways would pass all crossings.
  const Growth growth(static_cast<double>(bounded(radius)), tolerance);
  clipper::Paths milled;
  for (const DrawnRing& way : ways) std::ranges::move(growth.of_way(way), std::back_inserter(milled));
  return ways.size() == 1 ? Region{rings_of(milled)} : combined(clipper::ctUnion, std::move(milled), {});
}

std::vector<DrawnRing> ways_within(const std::vector<DrawnRing>& ways, const Region& region) {
  clipper::Clipper clip;
  clip.AddPaths(paths_of(ways), clipper::ptSubject, false);
  clip.AddPaths(paths_of(region.rings), clipper::ptClip, true);
  clipper::PolyTree found;
  clip.Execute(clipper::ctIntersection, found, clipper::pftNonZero, clipper::pftNonZero);
  clipper::Paths open;
  clipper::OpenPathsFromPolyTree(found, open);
  return rings_of(open);
}

std::vector<Region> parts_of(const Region& region) {
  struct Outer {
    std::size_t ring;
    DrawnBox box;
    Wide area;
  };
  std::vector<Outer> outers;
  std::vector<Region> parts;
  for (std::size_t i = 0; i < region.rings.size(); ++i) {
    const Wide area = doubled_area(region.rings[i]);
    if (area > 0) outers.push_back({i, box_of(region.rings[i]), area});
  }
  // From small to large: the first that a hole lies in is its own.
  std::ranges::stable_sort(outers, [](const Outer& a, const Outer& b) { return a.area < b.area; });
  for (const Outer& outer : outers) parts.push_back({{region.rings[outer.ring]}});
  for (const DrawnRing& ring : region.rings) {
    if (doubled_area(ring) >= 0) continue;
    const DrawnBox box = box_of(ring);
    for (std::size_t i = 0; i < outers.size(); ++i) {
      if (!is_within(box, outers[i].box) || !lies_in(ring, region.rings[outers[i].ring])) continue;
      parts[i].rings.push_back(ring);
      break;
    }
  }
  return parts;
}

std::vector<std::size_t> parts_with(const std::vector<Region>& islands, const std::vector<Region>& parts) {
  std::vector<DrawnBox> boxes;
  for (const Region& part : parts) boxes.push_back(bounds(part).value_or(DrawnBox{}));
  std::vector<std::size_t> found;
  for (const Region& island : islands) {
    const DrawnPoint point = island.rings.front().front();
    std::size_t i = 0;
    while (i < parts.size() && !(is_within({point, point}, boxes[i]) && contains(parts[i], point))) ++i;
    found.push_back(i);
  }
  return found;
}

double area_mm2(const DrawnRing& ring) {
  return ring.empty() ? 0 : static_cast<double>(doubled_area(ring)) / (2 * nanometres_per_mm * nanometres_per_mm);
}

double area_mm2(const Region& region) {
  Wide sum = 0;
  for (const DrawnRing& ring : region.rings) sum += doubled_area(ring);
  return static_cast<double>(sum) / (2 * nanometres_per_mm * nanometres_per_mm);
}

std::optional<DrawnBox> bounds(const Region& region) {
  std::optional<DrawnBox> all;
  for (const DrawnRing& ring : region.rings) {
    const DrawnBox box = box_of(ring);
    if (!all) all = box;
    all->least = {std::min(all->least.x, box.least.x), std::min(all->least.y, box.least.y)};
    all->most = {std::max(all->most.x, box.most.x), std::max(all->most.y, box.most.y)};
  }
  return all;
}

DrawnRing rectangle(const DrawnBox& box) {
  return {box.least, {box.most.x, box.least.y}, box.most, {box.least.x, box.most.y}};
}

bool contains(const Region& region, DrawnPoint point) {
  bool inside = false;
  for (const DrawnRing& ring : region.rings) {
    const int place = place_of(point, ring);
    if (place < 0) return true;
    if (place > 0) inside = !inside;
  }
  return inside;
}

}  // namespace passo
