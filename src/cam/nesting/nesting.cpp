#include "passo/nesting/nesting.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <optional>
#include <random>

#include "layout.hpp"
#include <fmt/format.h>

#include "passo/units/units.hpp"

namespace passo {
namespace {

using namespace nesting;

// A nanometre may be lost to rounding: outwards.
Extent extent_of_outlines(const std::vector<DrawnRing>& outlines, double degrees) {
  const NestPlacement turn{.degrees = degrees};
  Region all;
  for (const DrawnRing& ring : outlines) all.rings.push_back(placed(ring, turn));
  const DrawnBox box = bounds(all).value_or(DrawnBox{});
  const auto down = [](Nanometres at) {
    return std::llround(std::floor(static_cast<double>(at.count) / nanometres_per_step));
  };
  const auto up = [](Nanometres at) {
    return std::llround(std::ceil(static_cast<double>(at.count) / nanometres_per_step));
  };
  return {{down(box.least.x), down(box.least.y)}, {up(box.most.x), up(box.most.y)}};
}

DrawnPoint lower_left_of_outlines(const std::vector<DrawnRing>& outlines) {
  const Extent drawn = extent_of_outlines(outlines, 0);
  return {{drawn.least.X * nanometres_per_step}, {drawn.least.Y * nanometres_per_step}};
}

ClipperLib::Path box_path(const Spot& least, const Spot& most) {
  return {least, {most.X, least.Y}, most, {least.X, most.Y}};
}

// The positions of a turned shape on an empty sheet.
void find_places(TurnedShape& turned, const NestOptions& options, const Polygons& obstacles) {
  const ClipperLib::cInt margin = steps_of(options.margin);
  turned.places = {{margin - turned.extent.least.X, margin - turned.extent.least.Y},
                   {steps_of(options.sheet.x) - margin - turned.extent.most.X,
                    steps_of(options.sheet.y) - margin - turned.extent.most.Y}};
  const Extent& places = turned.places;
  if (places.least.X > places.most.X || places.least.Y > places.most.Y) return;
  // A shape that fits exactly has a place, too.
  turned.free = {box_path({places.least.X - 1, places.least.Y - 1}, {places.most.X + 1, places.most.Y + 1})};
  for (const auto& obstacle : obstacles) {
    const Polygons blocked = no_fit_polygon({obstacle}, turned.grown);
    turned.free = without(turned.free, {{&blocked, {0, 0}}});
  }
  turned.fits = !turned.free.empty();
}

Polygons grown_obstacles(const NestOptions& options) {
  const ClipperLib::cInt by = steps_of(options.gap) / 2 + 1;
  Polygons all;
  for (const DrawnBox& box : options.obstacles) {
    // Only the part near the sheet, so that all coordinates stay small.
    const auto on_sheet = [](Nanometres at, Nanometres most) {
      return steps_of(std::clamp(at, Nanometres{-most.count}, Nanometres{2 * most.count}));
    };
    const DrawnPoint& sheet = options.sheet;
    all.push_back(box_path({on_sheet(box.least.x, sheet.x) - by, on_sheet(box.least.y, sheet.y) - by},
                           {on_sheet(box.most.x, sheet.x) + by, on_sheet(box.most.y, sheet.y) + by}));
  }
  return all;
}

std::string sheet_words(const NestOptions& options) {
  return fmt::format("{:.6g} x {:.6g} mm with a margin of {:.4g} mm{}", to_mm(options.sheet.x).value(),
                     to_mm(options.sheet.y).value(), to_mm(options.margin).value(),
                     options.obstacles.empty() ? "" : " and clamps");
}

// A no-fit polygon takes time and memory for each pair of corners, and there is one for each pair of turned shapes.
std::size_t most_corners(std::size_t shapes, std::uint32_t rotations) {
  constexpr std::size_t of_all = 16'000;
  return std::clamp<std::size_t>(of_all / (shapes * rotations), 24, 300);
}

Result<ShapeToNest, NestFailure> prepared(const NestShape& shape, std::size_t index, std::size_t corners,
                                          const NestOptions& options, const Polygons& obstacles) {
  ShapeToNest ready;
  const double by = static_cast<double>(options.gap.count) / 2 / nanometres_per_step;
  const Extent drawn = extent_of_outlines(shape.outlines, 0);
  const auto mm = [](ClipperLib::cInt length) {
    return static_cast<double>(length * nanometres_per_step) / nanometres_per_mm;
  };
  const std::string size =
      fmt::format("{:.6g} x {:.6g} mm", mm(drawn.most.X - drawn.least.X), mm(drawn.most.Y - drawn.least.Y));
  const double largest = 2.0 * mm(steps_of(std::max(options.sheet.x, options.sheet.y)));
  const Failure<NestFailure> too_large{
      {index, fmt::format("'{}' of {} does not fit on a sheet of {}{}", shape.name, size, sheet_words(options),
                          options.rotations == 1 ? " as it is drawn" : "")}};
  if (mm(drawn.most.X - drawn.least.X) > largest || mm(drawn.most.Y - drawn.least.Y) > largest) return too_large;
  // The drawing may be far from 0,0: the shape is first moved near it.
  ready.area_mm2 = area_mm2(filled(shape.outlines));
  if (!(ready.area_mm2 > 0)) return Failure{NestFailure{index, fmt::format("'{}' has no area", shape.name)}};
  std::vector<DrawnRing> near = shape.outlines;
  const DrawnPoint corner = lower_left_of_outlines(near);
  for (DrawnRing& ring : near) {
    for (DrawnPoint& point : ring) point = {point.x - corner.x, point.y - corner.y};
  }
  const Polygons grown = grown_outside(near, by, corners);
  for (std::uint32_t i = 0; i < options.rotations; ++i) {
    TurnedShape turned_shape{.degrees = 360.0 * i / options.rotations};
    turned_shape.grown = turned(grown, turned_shape.degrees);
    turned_shape.extent = extent_of_outlines(near, turned_shape.degrees);
    find_places(turned_shape, options, obstacles);
    ready.turns.push_back(std::move(turned_shape));
  }
  if (std::ranges::none_of(ready.turns, &TurnedShape::fits)) return too_large;
  return ready;
}

// Changes of a sequence, always the same ones.
class Changes {
 public:
  Changes(const std::vector<ShapeToNest>& shapes) : shapes_(shapes) {}

  std::vector<LayoutItem> changed(std::vector<LayoutItem> sequence);

 private:
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(random_() % count); }
  void swap_two(std::vector<LayoutItem>& sequence);
  void turn_one(LayoutItem& item);

  const std::vector<ShapeToNest>& shapes_;
  std::mt19937_64 random_{20'240'901};
};

void Changes::swap_two(std::vector<LayoutItem>& sequence) {
  const std::size_t a = below(sequence.size());
  for (int attempt = 0; attempt < 8; ++attempt) {
    const std::size_t b = below(sequence.size());
    if (sequence[a].shape == sequence[b].shape && sequence[a].turn == sequence[b].turn) continue;
    std::swap(sequence[a], sequence[b]);
    return;
  }
  turn_one(sequence[a]);
}

void Changes::turn_one(LayoutItem& item) {
  const std::vector<TurnedShape>& turns = shapes_[item.shape].turns;
  const std::size_t chosen = below(turns.size() + 1);
  item.turn = chosen == turns.size() || !turns[chosen].fits ? any_turn : static_cast<std::uint8_t>(chosen);
}

std::vector<LayoutItem> Changes::changed(std::vector<LayoutItem> sequence) {
  const std::size_t count = 1 + below(3);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t kind = below(4);
    if (kind == 0) {
      turn_one(sequence[below(sequence.size())]);
    } else if (kind == 1) {
      // All copies of a shape in the same way.
      LayoutItem model = sequence[below(sequence.size())];
      turn_one(model);
      for (LayoutItem& item : sequence) {
        if (item.shape == model.shape) item.turn = model.turn;
      }
    } else if (kind == 2) {
      const std::size_t from = below(sequence.size());
      const std::size_t to = below(sequence.size());
      const LayoutItem item = sequence[from];
      sequence.erase(sequence.begin() + static_cast<std::ptrdiff_t>(from));
      sequence.insert(sequence.begin() + static_cast<std::ptrdiff_t>(to), item);
    } else {
      swap_two(sequence);
    }
  }
  return sequence;
}

// Whether two shapes have the same outlines, wherever they are: drawings repeat parts.
bool are_alike(const std::vector<DrawnRing>& a, const DrawnPoint& corner_a, const std::vector<DrawnRing>& b,
               const DrawnPoint& corner_b) {
  constexpr std::int64_t least = 500;  // nm
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].size() != b[i].size()) return false;
    for (std::size_t j = 0; j < a[i].size(); ++j) {
      const std::int64_t dx = (a[i][j].x.count - corner_a.x.count) - (b[i][j].x.count - corner_b.x.count);
      const std::int64_t dy = (a[i][j].y.count - corner_a.y.count) - (b[i][j].y.count - corner_b.y.count);
      if (std::abs(dx) > least || std::abs(dy) > least) return false;
    }
  }
  return true;
}

double longest_side(const ShapeToNest& shape) {
  const Extent& extent = shape.turns.front().extent;
  return static_cast<double>(std::max(extent.most.X - extent.least.X, extent.most.Y - extent.least.Y));
}

class NestSearch {
 public:
  NestSearch(LayoutMaker& maker, const std::vector<std::uint32_t>& quantities, std::uint32_t rounds)
      : maker_(maker), quantities_(quantities), rounds_(rounds) {}

  Layout run(const WorkProgress& progress);
  std::uint32_t layouts() const { return layouts_; }

 private:
  template <class Measure>
  std::vector<LayoutItem> largest_first(Measure measure) const;
  bool attempt(const std::vector<LayoutItem>& sequence, PlaceRule rule);
  bool may_go_on() const;

  LayoutMaker& maker_;
  const std::vector<std::uint32_t>& quantities_;
  std::uint32_t rounds_;
  std::uint32_t layouts_ = 0;
  double work_ = 0;
  std::optional<Layout> best_;
  std::vector<LayoutItem> sequence_;
  PlaceRule rule_ = PlaceRule::right;
};

template <class Measure>
std::vector<LayoutItem> NestSearch::largest_first(Measure measure) const {
  std::vector<std::uint32_t> order(quantities_.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, [&](std::uint32_t a, std::uint32_t b) {
    return std::invoke(measure, maker_.shapes()[a]) > std::invoke(measure, maker_.shapes()[b]);
  });
  std::vector<LayoutItem> sequence;
  for (const std::uint32_t shape : order) sequence.insert(sequence.end(), quantities_[shape], {.shape = shape});
  return sequence;
}

bool NestSearch::attempt(const std::vector<LayoutItem>& sequence, PlaceRule rule) {
  Layout layout = maker_.lay(sequence, rule);
  ++layouts_;
  work_ += layout.work;
  const bool is_better = !best_ || layout.is_better_than(*best_);
  const bool is_as_good = best_ && !best_->is_better_than(layout);
  if (is_better || is_as_good) {
    best_ = std::move(layout);
    sequence_ = sequence;
    rule_ = rule;
  }
  return is_better;
}

bool NestSearch::may_go_on() const {
  constexpr double most_work = 4e6;  // corners: some ten seconds of CPU time
  return layouts_ < rounds_ && work_ < most_work;
}

Layout NestSearch::run(const WorkProgress& progress) {
  const auto by_area = largest_first(&ShapeToNest::area_mm2);
  const auto by_length = largest_first(longest_side);
  attempt(by_area, PlaceRule::right);
  const bool is_one_kind = quantities_.size() == 1;
  for (const PlaceRule rule : {PlaceRule::left, PlaceRule::box, PlaceRule::corner}) {
    if (may_go_on()) attempt(by_area, rule);
  }
  for (const PlaceRule rule : {PlaceRule::right, PlaceRule::left, PlaceRule::box, PlaceRule::corner}) {
    if (may_go_on() && !is_one_kind) attempt(by_length, rule);
  }
  Changes changes(maker_.shapes());
  while (may_go_on()) {
    const std::vector<LayoutItem> next = changes.changed(sequence_);
    const std::uint32_t every = 7;
    const auto other = static_cast<PlaceRule>(layouts_ / every % 3);
    attempt(next, layouts_ % every == 0 ? other : rule_);
    progress.update(static_cast<double>(layouts_) / rounds_);
  }
  return std::move(*best_);
}

}  // namespace

DrawnPoint placed(DrawnPoint point, const NestPlacement& placement) {
  const double quarters = placement.degrees / 90;
  const DrawnPoint& by = placement.offset;
  const std::int64_t x = point.x.count;
  const std::int64_t y = point.y.count;
  if (quarters == std::floor(quarters)) {
    const auto quarter = ((static_cast<std::int64_t>(quarters) % 4) + 4) % 4;
    const std::int64_t turned_x = quarter == 0 ? x : quarter == 1 ? -y : quarter == 2 ? -x : y;
    const std::int64_t turned_y = quarter == 0 ? y : quarter == 1 ? x : quarter == 2 ? -y : -x;
    return {{turned_x + by.x.count}, {turned_y + by.y.count}};
  }
  const double angle = placement.degrees * std::numbers::pi / 180;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const auto dx = static_cast<double>(x);
  const auto dy = static_cast<double>(y);
  return {{std::llround(dx * c - dy * s) + by.x.count}, {std::llround(dx * s + dy * c) + by.y.count}};
}

DrawnRing placed(const DrawnRing& ring, const NestPlacement& placement) {
  DrawnRing all;
  all.reserve(ring.size());
  for (const DrawnPoint& point : ring) all.push_back(placed(point, placement));
  return all;
}

Result<Nest, NestFailure> nest_on_sheets(const std::vector<NestShape>& shapes, const NestOptions& options,
                                         const WorkProgress& progress) {
  std::uint64_t copies = 0;
  for (const NestShape& shape : shapes) copies += shape.quantity;
  if (copies > most_nested)
    return Failure{NestFailure{0, fmt::format("{} copies are more than {}", copies, most_nested)}};
  const Polygons obstacles = grown_obstacles(options);
  Nest nest;
  std::vector<DrawnPoint> corners;
  for (const NestShape& shape : shapes) corners.push_back(lower_left_of_outlines(shape.outlines));
  std::vector<ShapeToNest> kinds;
  std::vector<std::vector<std::size_t>> of_kinds;  // the shape of each copy
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const auto same = std::ranges::find_if(of_kinds, [&](const std::vector<std::size_t>& of_kind) {
      const std::size_t first = of_kind.front();
      return are_alike(shapes[i].outlines, corners[i], shapes[first].outlines, corners[first]);
    });
    const auto kind = static_cast<std::size_t>(same - of_kinds.begin());
    if (kind == of_kinds.size()) {
      auto ready = prepared(shapes[i], i, most_corners(shapes.size(), options.rotations), options, obstacles);
      if (!ready) return Failure{ready.error()};
      kinds.push_back(std::move(*ready));
      of_kinds.emplace_back();
    }
    of_kinds[kind].insert(of_kinds[kind].end(), shapes[i].quantity, i);
    nest.parts_mm2 += kinds[kind].area_mm2 * shapes[i].quantity;
  }
  if (copies == 0) return nest;
  std::vector<std::uint32_t> quantities;
  for (const auto& of_kind : of_kinds) quantities.push_back(static_cast<std::uint32_t>(of_kind.size()));
  LayoutMaker maker(std::move(kinds), options.rotations);
  NestSearch search(maker, quantities, std::max(1U, options.rounds));
  const Layout layout = search.run(progress);
  nest.layouts = search.layouts();
  for (const auto& laid : layout.sheets) {
    NestSheet sheet;
    for (const LaidCopy& copy : laid) {
      const TurnedShape& turn = maker.shapes()[copy.shape].turns[copy.turn];
      NestPlacement placement{.shape = of_kinds[copy.shape].back(), .degrees = turn.degrees};
      of_kinds[copy.shape].pop_back();
      const DrawnPoint corner = placed(corners[placement.shape], placement);
      placement.offset = {{copy.at.X * nanometres_per_step - corner.x.count},
                          {copy.at.Y * nanometres_per_step - corner.y.count}};
      sheet.placements.push_back(placement);
      sheet.used = std::max(sheet.used, Nanometres{(copy.at.X + turn.extent.most.X) * nanometres_per_step});
    }
    nest.sheets.push_back(std::move(sheet));
  }
  const double whole = to_mm(options.sheet.x).value() * to_mm(options.sheet.y).value();
  const double last = std::min(to_mm(options.sheet.x).value(), to_mm(nest.sheets.back().used + options.margin).value());
  nest.sheets_mm2 = whole * static_cast<double>(nest.sheets.size() - 1) + last * to_mm(options.sheet.y).value();
  progress.update(1);
  return nest;
}

}  // namespace passo
