#include "gerber_image.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>

namespace passo {
namespace {

constexpr std::size_t points_of_object = 4;  // what an object takes beside its points

std::size_t points_of(const Region& region) {
  std::size_t points = points_of_object;
  for (const DrawnRing& ring : region.rings) points += ring.size();
  return points;
}

bool overlap(const DrawnBox& a, const DrawnBox& b) {
  return a.least.x <= b.most.x && b.least.x <= a.most.x && a.least.y <= b.most.y && b.least.y <= a.most.y;
}

// A dark object, and where it is.
struct DarkObject {
  Region region;
  std::vector<DrawnBox> boxes;  // of its rings
  DrawnBox box;                 // of all
};

std::vector<DrawnBox> boxes_of(const Region& region) {
  std::vector<DrawnBox> boxes;
  boxes.reserve(region.rings.size());
  for (const DrawnRing& ring : region.rings) boxes.push_back(box_of(ring));
  return boxes;
}

// Clear objects take away from the dark objects that they touch, one by one: the others stay as they are.
class Composition {
 public:
  explicit Composition(RegionBudget& budget) : budget_(budget) {}

  void add(Region object) {
    const std::optional<DrawnBox> box = bounds(object);
    if (!box) return;
    std::vector<DrawnBox> boxes = boxes_of(object);
    dark_.push_back({std::move(object), std::move(boxes), *box});
  }

  bool take_away(std::vector<Region> objects) {
    std::erase_if(objects, [](const Region& object) { return object.empty(); });
    std::ranges::stable_sort(objects, {}, [](const Region& object) { return bounds(object)->least; });
    const std::optional<Region> united_clear = united_by_halves(std::move(objects));
    if (!united_clear) return false;
    const std::optional<DrawnBox> box = bounds(*united_clear);
    if (!box) return true;
    const std::vector<DrawnBox> boxes = boxes_of(*united_clear);
    for (DarkObject& dark : dark_) {
      looked_at_ += 1 + dark.boxes.size() / 8;
      if (looked_at_ > most_looked_at) return false;
      if (!overlap(dark.box, *box)) continue;
      looked_at_ += boxes.size() / 8;
      if (!take_away(near(*united_clear, boxes, dark.box), dark)) return false;
    }
    std::erase_if(dark_, [](const DarkObject& dark) { return dark.region.empty(); });
    return true;
  }

  // Halves of the board are united first: a sweep over a half passes half as many edges at each stop.
  std::optional<Region> take() {
    std::vector<Region> all;
    all.reserve(dark_.size());
    std::sort(dark_.begin(), dark_.end(), [](const DarkObject& a, const DarkObject& b) {
      return std::tie(a.box.least, a.box.most) < std::tie(b.box.least, b.box.most);
    });
    for (DarkObject& dark : dark_) all.push_back(std::move(dark.region));
    dark_.clear();
    return united_by_halves(std::move(all));
  }

 private:
  // The rings that come near a box: the others enclose nothing of it.
  static Region near(const Region& region, const std::vector<DrawnBox>& boxes, const DrawnBox& box) {
    Region rings;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (overlap(boxes[i], box)) rings.rings.push_back(region.rings[i]);
    }
    return rings;
  }

  // Rings that lie clear of what is taken away stay as they are: a plane's thousandth opening costs what its first did.
  bool take_away(const Region& clear, DarkObject& dark) {
    const std::optional<DrawnBox> box = bounds(clear);
    if (!box) return true;
    Region touched;
    std::vector<DrawnRing>& rings = dark.region.rings;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < rings.size(); ++i) {
      if (overlap(dark.boxes[i], *box)) {
        touched.rings.push_back(std::move(rings[i]));
        continue;
      }
      if (kept != i) {
        rings[kept] = std::move(rings[i]);
        dark.boxes[kept] = dark.boxes[i];
      }
      ++kept;
    }
    rings.resize(kept);
    dark.boxes.resize(kept);
    if (touched.empty()) return true;
    if (!budget_.affords({touched, clear})) return false;
    Region left = subtracted(touched, clear);
    std::ranges::copy(boxes_of(left), std::back_inserter(dark.boxes));
    std::ranges::move(left.rings, std::back_inserter(rings));
    return true;
  }

  std::optional<Region> united_by_halves(std::vector<Region> objects) {
    std::size_t points = 0;
    for (const Region& object : objects) points += points_of(object);
    constexpr std::size_t few = 20'000;
    if (points <= few || objects.size() < 4) {
      if (!budget_.affords(objects)) return std::nullopt;
      return united(objects);
    }
    const auto middle = objects.begin() + static_cast<std::ptrdiff_t>(objects.size() / 2);
    std::vector<Region> right(std::make_move_iterator(middle), std::make_move_iterator(objects.end()));
    objects.erase(middle, objects.end());
    const std::optional<Region> a = united_by_halves(std::move(objects));
    if (!a) return a;
    const std::optional<Region> b = united_by_halves(std::move(right));
    if (!b) return b;
    return joined(*a, *b);
  }

  // A ring that lies clear of the other half stays as it is, and only those along the seam are united. A hole may stay
  // while its outer ring is united: what is in it lies as clear of the other half as it does.
  std::optional<Region> joined(const Region& a, const Region& b) {
    const std::optional<DrawnBox> box_a = bounds(a);
    const std::optional<DrawnBox> box_b = bounds(b);
    if (!box_a) return b;
    if (!box_b) return a;
    std::vector<DrawnRing> clear;
    Region seam_a;
    Region seam_b;
    const auto part = [&clear](const Region& from, const DrawnBox& other, Region& seam) {
      for (const DrawnRing& ring : from.rings) {
        const bool touches = overlap(box_of(ring), other);
        (touches ? seam.rings : clear).push_back(ring);
      }
    };
    part(a, *box_b, seam_a);
    part(b, *box_a, seam_b);
    if (!budget_.affords({seam_a, seam_b})) return std::nullopt;
    Region all = united(seam_a, seam_b);
    all.rings.insert(all.rings.end(), std::make_move_iterator(clear.begin()), std::make_move_iterator(clear.end()));
    return all;
  }

  static constexpr std::size_t most_looked_at = 2'000'000'000;
  RegionBudget& budget_;
  std::vector<DarkObject> dark_;
  std::size_t looked_at_ = 0;
};

}  // namespace

DrawnPoint GerberPlacement::placed(DrawnPoint point) const {
  if (only_moves()) return moved(point, at);
  Offset place{static_cast<double>(mirrors_x ? -point.x.count : point.x.count),
               static_cast<double>(mirrors_y ? -point.y.count : point.y.count)};
  if (radians != 0) place = turned(place, radians);
  return moved(rounded({place.x * scale, place.y * scale}), at);
}

DrawnRing GerberPlacement::placed(const DrawnRing& ring) const {
  DrawnRing result;
  result.reserve(ring.size());
  for (const DrawnPoint& point : ring) result.push_back(placed(point));
  if (mirrors_x != mirrors_y) std::ranges::reverse(result);
  return result;
}

Region GerberPlacement::placed(const Region& region) const {
  Region result;
  result.rings.reserve(region.rings.size());
  for (const DrawnRing& ring : region.rings) result.rings.push_back(placed(ring));
  return result;
}

// A stroke of an aperture without a face, as of a macro that draws nothing, has rings of no points.
void GerberImage::add(Region object, bool is_dark) {
  std::erase_if(object.rings, [](const DrawnRing& ring) { return ring.size() < 3; });
  if (object.empty()) return;
  points += points_of(object);
  if (runs.empty() || runs.back().is_dark != is_dark) runs.push_back({is_dark, {}});
  runs.back().objects.push_back(std::move(object));
}

void GerberImage::add(const GerberImage& image, const GerberPlacement& placement, bool is_dark) {
  for (const Run& run : image.runs) {
    for (const Region& object : run.objects) add(placement.placed(object), run.is_dark == is_dark);
  }
  if (is_dark) {
    for (GerberPad pad : image.pads) {
      pad.at = placement.placed(pad.at);
      pads.push_back(pad);
    }
    for (GerberPad place : image.named) {
      place.at = placement.placed(place.at);
      named.push_back(place);
    }
    for (DrawnPath path : image.strokes) {
      for (PathPoint& point : path.points) {
        point.at = placement.placed(point.at);
        if (placement.mirrors_x != placement.mirrors_y) point.bulge = -point.bulge;
      }
      path.width.count = std::llround(static_cast<double>(path.width.count) * placement.scale);
      strokes.push_back(std::move(path));
    }
  }
  points += 2 * (image.pads.size() + image.named.size()) + points_of_object;
  for (const DrawnPath& path : image.strokes) points += path.points.size();
}

std::optional<Region> composed(GerberImage image, RegionBudget& budget) {
  Composition composition(budget);
  for (GerberImage::Run& run : image.runs) {
    if (run.is_dark) {
      for (Region& object : run.objects) composition.add(std::move(object));
    } else if (!composition.take_away(run.objects)) {
      return std::nullopt;
    }
    run.objects = {};
  }
  return composition.take();
}

}  // namespace passo
