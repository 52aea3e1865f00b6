#include "passo/cam/v_carve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>
#include <vector>

#include "medial_axis.hpp"
#include "nested_loops.hpp"
#include "stroke_fit.hpp"
#include "stroke_tour.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

constexpr double least_turn_of_corners = 25 * std::numbers::pi / 180;

class VCarvePlanner {
 public:
  VCarvePlanner(const Region& area, const VCarveOptions& options, Diagnostics& diagnostics)
      : area_(area), options_(options), diagnostics_(diagnostics) {
    slope_ = std::tan(options.angle_degrees / 360 * std::numbers::pi);
    least_ = static_cast<double>(options.tip.count) / 2;
    // At the face the cutter is wider than where the lines lie.
    most_ = static_cast<double>(options.widest.count) / 2 + static_cast<double>(options.start.count) * slope_;
    if (options.deepest.count < 0) {
      most_ = std::min(most_, least_ - static_cast<double>(options.deepest.count) * slope_);
    }
  }

  VCarvePlan plan(const WorkProgress& progress) {
    if (most_ <= least_) {
      refuse_cutter();
      return {};
    }
    const auto axis = medial_axis(
        area_, {.least_turn = least_turn_of_corners, .tolerance_nm = static_cast<double>(options_.tolerance.count)});
    if (area_.empty() || !axis) {
      refuse(area_.empty() ? "these files have no closed contour" : "the drawing is wider than 4 m");
      return {};
    }
    progress.update(0.8);
    nodes_ = axis->nodes;
    for (const MedialPiece& piece : axis->pieces) clip(piece);
    // Beside its tip the cutter mills as wide as it is deep there: the drawing itself.
    MillTool tool{options_.tip, options_.words, {}};
    go_around_floors();
    progress.update(0.9);
    for (const CutterStroke& stroke : strokes_) {
      for (const MillPoint& point : stroke.points) plan_.deepest = std::min(plan_.deepest, point.z);
    }
    tool.runs = in_layers();
    progress.update(0.95);
    if (!tool.runs.empty()) plan_.mill.tools.push_back(std::move(tool));
    if (options_.tip.count > 0) {
      constexpr Nanometres small{10'000};
      const Nanometres half{options_.tip.count / 2};
      const Region wide = grown(grown(area_, {-half.count}), half + small);
      // In corners the tip leaves a little everywhere: what counts is where it finds no way in at all.
      plan_.unreached = notable_part(subtracted(area_, wide), {std::max<std::int64_t>(small.count, half.count / 4)});
    }
    progress.update(1);
    return std::move(plan_);
  }

 private:
  void refuse(std::string message) {
    diagnostics_.add({.code = "engrave.no-area",
                      .file = "",
                      .place = {},
                      .message = std::move(message),
                      .expected = "closed contours around the areas to carve",
                      .text = ""});
  }
  void refuse_cutter() {
    diagnostics_.add({.code = "engrave.narrow-cutter",
                      .file = "",
                      .place = {},
                      .message = fmt::format("the cutter is too narrow to start at a depth of {:.4g} mm",
                                             -to_mm(options_.start).value()),
                      .expected = "a wider --tool, a smaller --angle or a smaller depth",
                      .text = ""});
  }
  Nanometres depth_at(double clearance) const {
    return {options_.start.count - std::llround((std::clamp(clearance, least_, most_) - least_) / slope_)};
  }
  void clip(const MedialPiece& piece);
  void go_around_floors();
  void add_floor_ring(const DrawnRing& ring, const std::vector<std::pair<DrawnPoint, std::size_t>>& ends);
  void append_runs(std::vector<CutterStroke> strokes, std::vector<MillRun>& runs) const;
  std::vector<MillRun> in_layers();

  const Region& area_;
  const VCarveOptions& options_;
  Diagnostics& diagnostics_;
  double slope_ = 1;  // half of the width for the depth
  double least_ = 0;  // the clearances that the cutter can use, nm
  double most_ = 0;
  std::size_t nodes_ = 0;
  std::vector<CutterStroke> strokes_;  // the parts of the axis that are cut
  VCarvePlan plan_;
};

// Leaves what is narrower than the tip, and what is a floor.
void VCarvePlanner::clip(const MedialPiece& piece) {
  const auto is_in = [&](const MedialPoint& p) { return p.clearance >= least_ && p.clearance <= most_; };
  const auto place = [&](const MedialPoint& p) {
    return MillPoint{{{std::llround(p.x)}, {std::llround(p.y)}}, 0, depth_at(p.clearance)};
  };
  CutterStroke stroke{is_in(piece.points.front()) ? piece.from : nodes_++, 0, {}};
  const auto end = [&](std::size_t node) {
    stroke.to = node;
    if (stroke.points.size() > 1) strokes_.push_back(std::move(stroke));
    stroke = {nodes_++, 0, {}};
  };
  for (std::size_t i = 0; i < piece.points.size(); ++i) {
    const MedialPoint& p = piece.points[i];
    if (i > 0) {
      // Where the clearance passes a bound between two points.
      const MedialPoint& before = piece.points[i - 1];
      std::vector<double> shares;
      for (const double bound : {least_, most_}) {
        const double share = (bound - before.clearance) / (p.clearance - before.clearance);
        if (std::isfinite(share) && share > 0 && share < 1) shares.push_back(share);
      }
      std::ranges::sort(shares);
      for (const double share : shares) {
        const MedialPoint passed{before.x + share * (p.x - before.x), before.y + share * (p.y - before.y),
                                 before.clearance + share * (p.clearance - before.clearance)};
        const bool leaves = !stroke.points.empty();
        stroke.points.push_back(place(passed));
        if (leaves) end(nodes_++);
      }
    }
    if (is_in(p)) {
      const MillPoint next = place(p);
      const bool is_same =
          !stroke.points.empty() && stroke.points.back().at == next.at && stroke.points.back().z == next.z;
      if (!is_same) stroke.points.push_back(next);
    } else if (stroke.points.size() == 1) {
      stroke.points.clear();
    }
  }
  if (!stroke.points.empty()) end(piece.to);
}

// A branch ends at a corner of the floor. There the ring goes through its end, so that the cutter stays down.
void VCarvePlanner::add_floor_ring(const DrawnRing& ring, const std::vector<std::pair<DrawnPoint, std::size_t>>& ends) {
  constexpr Nanometres reach{12'000};
  constexpr std::size_t no_node = static_cast<std::size_t>(-1);
  MillRun points;
  std::vector<std::size_t> nodes(ring.size(), no_node);
  std::size_t first = ring.size();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    points.push_back({ring[i], 0, plan_.floor_z});
    double nearest = static_cast<double>(reach.count);
    const auto from =
        std::ranges::lower_bound(ends, ring[i].x - reach, {}, [](const auto& end) { return end.first.x; });
    for (auto end = from; end != ends.end() && end->first.x < ring[i].x + reach; ++end) {
      const double away = distance_nm(end->first, ring[i]);
      if (away > nearest || (i > 0 && points[i - 1].at == end->first)) continue;
      nearest = away;
      points[i].at = end->first;
      nodes[i] = end->second;
    }
    if (nodes[i] != no_node) first = std::min(first, i);
  }
  if (first == ring.size()) {
    first = 0;
    nodes[0] = nodes_++;
  }
  CutterStroke stroke{nodes[first], 0, {points[first]}};
  for (std::size_t k = 1; k <= ring.size(); ++k) {
    const std::size_t i = (first + k) % ring.size();
    stroke.points.push_back(points[i]);
    if (nodes[i] == no_node) continue;
    stroke.to = nodes[i];
    strokes_.push_back(std::move(stroke));
    stroke = {nodes[i], 0, {points[i]}};
  }
}

void VCarvePlanner::go_around_floors() {
  plan_.floor_z = depth_at(most_);
  // A little beyond, so that a stroke of just this width has no floor.
  plan_.floor = grown(area_, {-std::llround(most_) - options_.tolerance.count}, options_.tolerance);
  std::vector<std::pair<DrawnPoint, std::size_t>> ends;
  for (const CutterStroke& stroke : strokes_) {
    if (stroke.points.front().z == plan_.floor_z) ends.emplace_back(stroke.points.front().at, stroke.from);
    if (stroke.points.back().z == plan_.floor_z) ends.emplace_back(stroke.points.back().at, stroke.to);
  }
  std::ranges::sort(ends);
  for (const DrawnRing& ring : plan_.floor.rings) add_floor_ring(ring, ends);
}

// The place of a straight way at which it passes a depth.
MillPoint at_depth(const MillPoint& from, const MillPoint& to, Nanometres z) {
  const double share = static_cast<double>(z.count - from.z.count) / static_cast<double>(to.z.count - from.z.count);
  const auto between = [&](Nanometres a, Nanometres b) {
    return Nanometres{a.count + std::llround(share * static_cast<double>(b.count - a.count))};
  };
  return {{between(from.at.x, to.at.x), between(from.at.y, to.at.y)}, 0, z};
}

// A layer of a stroke: its parts below `above`, no deeper than `limit`.
void add_layer(const CutterStroke& stroke, Nanometres above, Nanometres limit, std::size_t& nodes,
               std::vector<CutterStroke>& layer) {
  const MillRun& run = stroke.points;
  MillRun part;
  bool is_first = true;
  const auto end = [&] {
    if (part.size() > 1) {
      const bool has_start = is_first && part.front().at == run.front().at;
      const bool has_end = part.back().at == run.back().at;
      const std::size_t from = has_start ? stroke.from : nodes++;
      layer.push_back({from, has_end ? stroke.to : nodes++, std::move(part)});
    }
    is_first = false;
    part.clear();
  };
  const auto add = [&](MillPoint point) {
    point.z = std::max(point.z, limit);
    if (part.empty() || part.back().at != point.at || part.back().z != point.z) part.push_back(point);
  };
  for (std::size_t i = 0; i < run.size(); ++i) {
    const MillPoint& here = run[i];
    if (i > 0) {
      const MillPoint& before = run[i - 1];
      // The depths that the way passes, in its order.
      std::array<Nanometres, 2> bounds = {above, limit};
      if (here.z > before.z) std::swap(bounds[0], bounds[1]);
      for (const Nanometres bound : bounds) {
        const bool passes = (before.z < bound && bound < here.z) || (here.z < bound && bound < before.z);
        if (!passes) continue;
        add(at_depth(before, here, bound));
        if (bound == above && here.z > above) end();
      }
    }
    if (here.z < above || (here.z == above && !part.empty())) {
      add(here);
    } else if (here.z == above) {
      const bool goes_down = i + 1 < run.size() && run[i + 1].z < above;
      if (goes_down) add(here);
    }
    if (here.z >= above && !part.empty() && (i + 1 == run.size() || run[i + 1].z >= above)) end();
  }
  end();
}

void VCarvePlanner::append_runs(std::vector<CutterStroke> strokes, std::vector<MillRun>& runs) const {
  const StrokeFit fit{static_cast<double>(options_.fit.count), slope_};
  const StrokeTour tour{runs.empty() ? options_.park : runs.back().back().at,
                        static_cast<double>(options_.longest_return.count)};
  std::ranges::move(tour_strokes(fit_strokes(std::move(strokes), nodes_, fit), nodes_, tour), std::back_inserter(runs));
}

std::vector<MillRun> VCarvePlanner::in_layers() {
  const Nanometres deepest = plan_.deepest;
  const std::int64_t step = options_.step.count;
  if (step > 0) plan_.layers = static_cast<std::size_t>(std::max<std::int64_t>(1, (-deepest.count + step - 1) / step));
  std::vector<MillRun> runs;
  if (plan_.layers == 1) {
    append_runs(std::move(strokes_), runs);
    return runs;
  }
  for (std::size_t i = 0; i < plan_.layers; ++i) {
    const auto depth = [&](std::size_t layer) {
      return Nanometres{std::max(deepest.count, -static_cast<std::int64_t>(layer) * step)};
    };
    // All ways begin in the first layer, those at the face too.
    const Nanometres above = i == 0 ? Nanometres{1} : depth(i);
    std::vector<CutterStroke> layer;
    for (const CutterStroke& stroke : strokes_) add_layer(stroke, above, depth(i + 1), nodes_, layer);
    append_runs(std::move(layer), runs);
  }
  return runs;
}

}  // namespace

std::vector<MillRun> clean_floor(const Region& left, Nanometres z, Nanometres apart, Nanometres step) {
  constexpr std::size_t most_loops = 20'000;
  std::vector<MillRun> layer;
  DrawnRing last;
  std::size_t loops = 0;
  for (const Region& part : parts_of(left)) {
    Region inside = part;
    for (std::int64_t k = 0; !inside.empty(); inside = grown(part, {-++k * apart.count})) {
      loops += inside.rings.size();
      if (loops > most_loops) return {};
      for (DrawnRing ring : inside.rings) {
        // Begins where the last loop ended, if that is near.
        const DrawnPoint from = last.empty() ? ring.front() : last.back();
        const auto nearest =
            std::ranges::min_element(ring, {}, [&](const DrawnPoint& at) { return distance_nm(at, from); });
        std::rotate(ring.begin(), nearest, ring.end());
        ring.push_back(ring.front());
        const bool is_near =
            k > 0 && !last.empty() && distance_nm(from, ring.front()) < 3 * static_cast<double>(apart.count);
        if (!is_near) layer.emplace_back();
        for (const DrawnPoint& point : ring) layer.back().push_back({point, 0, z});
        last = std::move(ring);
      }
    }
  }
  const std::int64_t layers = step.count > 0 ? std::max<std::int64_t>(1, (-z.count + step.count - 1) / step.count) : 1;
  std::vector<MillRun> runs;
  for (std::int64_t i = 1; i <= layers; ++i) {
    for (MillRun run : layer) {
      for (MillPoint& point : run) point.z = {z.count * i / layers};
      runs.push_back(std::move(run));
    }
  }
  return runs;
}

VCarvePlan plan_v_carve(const Region& area, const VCarveOptions& options, Diagnostics& diagnostics,
                        const WorkProgress& progress) {
  return VCarvePlanner(area, options, diagnostics).plan(progress);
}

}  // namespace passo
