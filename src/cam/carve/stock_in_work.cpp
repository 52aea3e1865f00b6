#include "stock_in_work.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "passo/carve/relief_surface.hpp"
#include "passo/stock/cut_target.hpp"

namespace passo {
namespace {

std::vector<Cutter> cutters_of(const ReliefProgramOptions& options) {
  std::vector<Cutter> cutters = {options.finish.cutter};
  if (options.roughing) cutters.push_back(options.roughing->tool.cutter);
  if (options.rest) cutters.push_back(options.rest->tool.cutter);
  return cutters;
}

// `share`: the size of a cell, as a fraction of the smallest cutter's radius.
HeightField field_for(const HeightGrid& surface, const ReliefProgramOptions& options, Mm beyond, double share,
                      double most_cells) {
  Mm smallest = options.finish.cutter.radius;
  Mm largest = smallest;
  for (const Cutter& cutter : cutters_of(options)) {
    smallest = std::min(smallest, cutter.radius);
    largest = std::max(largest, cutter.radius);
  }
  const double of_nodes = std::min(std::min(surface.pitch_x, surface.pitch_y), smallest / 2).value();
  const double reach = (beyond + largest).value();
  const double area = (surface.width().value() + 2 * reach) * (surface.length().value() + 2 * reach);
  const double finest = std::sqrt(area / most_cells);
  const double cell = std::clamp(std::max({finest, smallest.value() * share, of_nodes}), 0.01, 10.0);
  // Stock remains at the edge of the area that the cutters reach, so there are cells beyond it.
  const double rim = reach + 2 * cell;
  const double deep = static_cast<double>(floor_of(surface)) - 1;
  // What is wider than any stock counts as cut beyond: only huge works of coarse nodes are.
  constexpr double widest = 9'999;
  StockBlock block{
      .low = {options.x0.value() - rim, options.y0.value() - rim, deep},
      .high = {(options.x0 + surface.width()).value() + rim, (options.y0 + surface.length()).value() + rim, 0}};
  block.high.x = std::min(block.high.x, block.low.x + widest);
  block.high.y = std::min(block.high.y, block.low.y + widest);
  return *HeightField::create(block, Mm(cell));
}

Point point_of(const CarvedPlace& place) {
  Point point;
  point[Axis::x] = static_cast<double>(place.x) / carved_units;
  point[Axis::y] = static_cast<double>(place.y) / carved_units;
  point[Axis::z] = static_cast<double>(place.z) / carved_units;
  return point;
}

Curve curve_of(const CarvedCut& cut) {
  const Point from = point_of(cut.from);
  const Point to = point_of(cut.to);
  if (cut.kind == CarvedCut::Kind::line) return Curve::line(from, to);
  const Point centre = point_of(cut.centre);
  const Axis first = cut.kind == CarvedCut::Kind::arc_zx   ? Axis::z
                     : cut.kind == CarvedCut::Kind::arc_yz ? Axis::y
                                                           : Axis::x;
  const Axis second = cut.kind == CarvedCut::Kind::arc_zx   ? Axis::x
                      : cut.kind == CarvedCut::Kind::arc_yz ? Axis::z
                                                            : Axis::y;
  const double angle = sweep_of(cut).angle;
  return Curve::arc(from, to, first, second, centre[first], centre[second], cut.counterclockwise ? angle : -angle);
}

}  // namespace

StockInWork::StockInWork(const HeightGrid& surface, const ReliefProgramOptions& options, Mm beyond, Watcher watcher)
    : heights_{.field = field_for(surface, options, beyond, 0.125, 6e6)},
      bound_{.field = field_for(surface, options, beyond, 0.3, 1e6)},
      x0_(options.x0.value()),
      y0_(options.y0.value()),
      shapes_(cutters_of(options)) {
  StockCutterOptions cutting{.threads = options.threads};
  StockCutterOptions thinner{.threads = options.threads};
  const Mm by = thinner_for(Mm(bound_.field.cell()));
  for (const Cutter& shape : shapes_) {
    cutting.tools.push_back({.cutter = shape});
    thinner.tools.push_back({.cutter = thinned(shape, by)});
    raised_.push_back(thinned_tip(shape, by));
  }
  StockCutter::Watcher watch;
  if (watcher) {
    watch = [watcher = std::move(watcher)](const MoveCut& cut) { watcher(cut.move.line, cut.volume); };
  }
  heights_.cutter = std::make_unique<StockCutter>(heights_.field, cutting, std::move(watch));
  bound_.cutter = std::make_unique<StockCutter>(bound_.field, thinner, nullptr);
}

void StockInWork::use(const Cutter& cutter) {
  const auto same = [&](const Cutter& shape) {
    return shape.radius == cutter.radius && shape.flat == cutter.flat && shape.corner == cutter.corner &&
           shape.half_angle.value == cutter.half_angle.value;
  };
  tool_ = static_cast<std::size_t>(std::find_if(shapes_.begin(), shapes_.end(), same) - shapes_.begin());
}

void StockInWork::cut(const CarvedCut& cut, std::uint32_t number) {
  const Curve curve = curve_of(cut);
  heights_.cutter->cut(curve, {}, {.line = number, .tool = tool_});
  bound_.cutter->cut(curve, {0, 0, -raised_[tool_].value()}, {.tool = tool_});
  is_settled_ = false;
}

void StockInWork::settle() {
  if (!is_settled_) heights_.cutter->finish();
  is_settled_ = true;
}

// The stock of a cell may stand half a diagonal away from its middle.
void StockInWork::measure(Layer& layer, double around, double inside) const {
  if (layer.around == around && layer.inside == inside && layer.tool == tool_) return;
  layer.around = around;
  layer.inside = inside;
  layer.tool = tool_;
  const Cutter& shape = shapes_[tool_];
  const double cell = layer.field.cell();
  const double near = around + cell * 0.75;
  const double wide = inside + near;
  layer.reach = static_cast<std::ptrdiff_t>(wide / cell) + 1;
  layer.heights.clear();
  for (std::ptrdiff_t row = 0; row <= layer.reach; ++row) {
    for (std::ptrdiff_t column = 0; column <= layer.reach; ++column) {
      const double away = std::hypot(static_cast<double>(column), static_cast<double>(row)) * cell;
      const Mm inner(std::max(0.0, away - near));
      layer.heights.push_back(away <= wide ? static_cast<float>(shape.height(inner).value())
                                           : std::numeric_limits<float>::infinity());
    }
  }
}

double StockInWork::free_height(const FlatPlace& place, double around) {
  return highest(heights_, place, around, shapes_[tool_].radius.value());
}

double StockInWork::rapid_height(const FlatPlace& place) {
  bound_.cutter->finish();
  return highest(bound_, place, bound_.field.cell() * 0.75, shapes_[tool_].radius.value());
}

// `inside`: the distance from the axis within which the cutter must touch nothing.
double StockInWork::highest(Layer& layer, const FlatPlace& place, double around, double inside) {
  settle();
  measure(layer, around, inside);
  const HeightField& field = layer.field;
  const StockBlock& block = field.block();
  const std::ptrdiff_t reach = layer.reach;
  const auto column = static_cast<std::ptrdiff_t>(std::floor((place.x + x0_ - block.low.x) / field.cell()));
  const auto row = static_cast<std::ptrdiff_t>(std::floor((place.y + y0_ - block.low.y) / field.cell()));
  const auto last_column = static_cast<std::ptrdiff_t>(field.columns()) - 1;
  const auto last_row = static_cast<std::ptrdiff_t>(field.rows()) - 1;
  auto top = static_cast<float>(field.bottom() - field.top());
  for (std::ptrdiff_t y = std::max<std::ptrdiff_t>(0, row - reach); y <= std::min(last_row, row + reach); ++y) {
    const float* const cells = field.below_top(static_cast<std::size_t>(y));
    const float* const shape = &layer.heights[static_cast<std::size_t>(std::abs(y - row) * (reach + 1))];
    for (std::ptrdiff_t x = std::max<std::ptrdiff_t>(0, column - reach); x <= std::min(last_column, column + reach);
         ++x) {
      top = std::max(top, cells[x] - shape[std::abs(x - column)]);
    }
  }
  return static_cast<double>(top);
}

double StockInWork::free_height(const std::vector<CarvedCut>& way) {
  const double radius = shapes_[tool_].radius.value();
  double highest = -std::numeric_limits<double>::infinity();
  double since = radius;  // mm, since the last place that was looked at
  for (const CarvedCut& cut : way) {
    const Curve curve = curve_of(cut);
    const double length = curve.length().value();
    since += length;
    if (since < radius / 2 && &cut != &way.back()) continue;
    const double parts = std::ceil(length / radius);
    for (double i = 0; i <= parts; ++i) {
      const Point here = curve.at(Mm(parts > 0 ? length * i / parts : 0));
      highest = std::max(highest, free_height({here[Axis::x] - x0_, here[Axis::y] - y0_}, radius / 2));
    }
    since = 0;
  }
  return highest;
}

double StockInWork::free_height_inside(const FlatPlace& place) {
  return highest(heights_, place, 0, radius() / 2);
}

double StockInWork::free_height_inside(const std::vector<CarvedCut>& way) {
  const double radius = shapes_[tool_].radius.value();
  const double apart = radius / 4;
  double highest_place = -std::numeric_limits<double>::infinity();
  double since = apart;
  for (const CarvedCut& cut : way) {
    const Curve curve = curve_of(cut);
    const double length = curve.length().value();
    since += length;
    if (since < apart && &cut != &way.back()) continue;
    const double parts = std::ceil(length / apart);
    for (double i = 0; i <= parts; ++i) {
      const Point here = curve.at(Mm(parts > 0 ? length * i / parts : 0));
      highest_place =
          std::max(highest_place, highest(heights_, {here[Axis::x] - x0_, here[Axis::y] - y0_}, apart, radius / 2));
    }
    since = 0;
  }
  return highest_place;
}

}  // namespace passo
