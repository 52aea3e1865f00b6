#include "voronoi_lines.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "flat_vector.hpp"
#include "medial_axis.hpp"
#include "stroke_walk.hpp"
#include "thin_line.hpp"

namespace passo {
namespace {

constexpr double chord_tolerance = 1'000;  // nm, of the axis, and again of what is left out of it

// The ground around the islands, to the left of its rings, out to where it has no say within the box.
Region ground_of(const std::vector<Region>& islands, const DrawnBox& box, std::vector<std::uint32_t>& owners) {
  const std::int64_t around =
      2 * ((box.most.x.count - box.least.x.count) + (box.most.y.count - box.least.y.count)) + 1'000'000;
  Region ground{{rectangle({{{box.least.x.count - around}, {box.least.y.count - around}},
                            {{box.most.x.count + around}, {box.most.y.count + around}}})}};
  owners = {nobody};
  for (std::uint32_t i = 0; i < islands.size(); ++i) {
    for (const DrawnRing& ring : islands[i].rings) {
      ground.rings.emplace_back(ring.rbegin(), ring.rend());
      owners.push_back(i);
    }
  }
  return ground;
}

}  // namespace

std::optional<std::vector<DrawnRing>> voronoi_lines(const std::vector<Region>& islands, const DrawnBox& box) {
  constexpr std::int64_t widest = 1'000'000'000;  // nm: with what is around, within the reach of the medial axis
  if (box.most.x.count - box.least.x.count + box.most.y.count - box.least.y.count > widest) return std::nullopt;
  MedialOptions options{.least_turn = 0, .tolerance_nm = chord_tolerance};
  const Region ground = ground_of(islands, box, options.owners);
  const std::optional<MedialAxis> axis = medial_axis(ground, options);
  if (!axis) return std::nullopt;
  std::vector<CutterStroke> strokes;
  for (const MedialPiece& piece : axis->pieces) {
    CutterStroke stroke{piece.from, piece.to, {}};
    for (const MedialPoint& point : piece.points)
      stroke.points.push_back({{{std::llround(point.x)}, {std::llround(point.y)}}, 0, {}});
    strokes.push_back(std::move(stroke));
  }
  std::vector<DrawnRing> lines;
  for (const MillRun& run : walk_strokes(std::move(strokes), axis->nodes, box.least)) {
    DrawnRing line;
    for (const MillPoint& point : run) line.push_back(point.at);
    lines.push_back(thinned(line, chord_tolerance));
  }
  return lines;
}

}  // namespace passo
