#include "stock_in_work.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "passo/carve/relief_surface.hpp"

namespace passo {
namespace {

std::vector<Cutter> cutters_of(const ReliefProgramOptions& options) {
  std::vector<Cutter> cutters = {options.finish.cutter};
  if (options.roughing) cutters.push_back(options.roughing->tool.cutter);
  if (options.rest) cutters.push_back(options.rest->tool.cutter);
  return cutters;
}

HeightField field_for(const HeightGrid& surface, const ReliefProgramOptions& options, Mm beyond) {
  Mm smallest = options.finish.cutter.radius;
  Mm largest = smallest;
  for (const Cutter& cutter : cutters_of(options)) {
    smallest = std::min(smallest, cutter.radius);
    largest = std::max(largest, cutter.radius);
  }
  const double rim = (beyond + largest).value();
  const double deep = static_cast<double>(floor_of(surface)) - 1;
  // What is wider than any stock counts as cut beyond: only huge works of coarse nodes are.
  constexpr double widest = 9'999;
  StockBlock block{
      .low = {options.x0.value() - rim, options.y0.value() - rim, deep},
      .high = {(options.x0 + surface.width()).value() + rim, (options.y0 + surface.length()).value() + rim, 0}};
  block.high.x = std::min(block.high.x, block.low.x + widest);
  block.high.y = std::min(block.high.y, block.low.y + widest);
  constexpr double most_cells = 6e6;
  const double area = (block.high.x - block.low.x) * (block.high.y - block.low.y);
  const double finest = std::sqrt(area / most_cells);
  const double of_nodes = std::min(std::min(surface.pitch_x, surface.pitch_y), smallest / 2).value();
  return *HeightField::create(block, Mm(std::clamp(std::max({finest, smallest.value() / 10, of_nodes}), 0.01, 10.0)));
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
    : field_(field_for(surface, options, beyond)),
      x0_(options.x0.value()),
      y0_(options.y0.value()),
      shapes_(cutters_of(options)) {
  StockCutterOptions cutting{.threads = options.threads};
  for (const Cutter& shape : shapes_) cutting.tools.push_back({.cutter = shape});
  StockCutter::Watcher watch;
  if (watcher) {
    watch = [watcher = std::move(watcher)](const MoveCut& cut) { watcher(cut.move.line, cut.volume); };
  }
  cutter_ = std::make_unique<StockCutter>(field_, cutting, std::move(watch));
}

void StockInWork::use(const Cutter& cutter) {
  const auto same = [&](const Cutter& shape) {
    return shape.radius == cutter.radius && shape.flat == cutter.flat && shape.corner == cutter.corner &&
           shape.half_angle.value == cutter.half_angle.value;
  };
  tool_ = static_cast<std::size_t>(std::find_if(shapes_.begin(), shapes_.end(), same) - shapes_.begin());
}

void StockInWork::cut(const CarvedCut& cut, std::uint32_t number) {
  cutter_->cut(curve_of(cut), {}, {.line = number, .tool = tool_});
  is_settled_ = false;
}

void StockInWork::settle() {
  if (!is_settled_) cutter_->finish();
  is_settled_ = true;
}

// The stock of a cell may stand half a diagonal away from its middle.
void StockInWork::measure(double around, double inside) {
  if (measured_around_ == around && measured_inside_ == inside && measured_tool_ == tool_) return;
  measured_around_ = around;
  measured_inside_ = inside;
  measured_tool_ = tool_;
  const Cutter& shape = shapes_[tool_];
  const double near = around + field_.cell() * 0.75;
  const double wide = inside + near;
  reach_ = static_cast<std::ptrdiff_t>(wide / field_.cell()) + 1;
  heights_.clear();
  for (std::ptrdiff_t row = 0; row <= reach_; ++row) {
    for (std::ptrdiff_t column = 0; column <= reach_; ++column) {
      const double away = std::hypot(static_cast<double>(column), static_cast<double>(row)) * field_.cell();
      const Mm inner(std::max(0.0, away - near));
      heights_.push_back(away <= wide ? static_cast<float>(shape.height(inner).value())
                                      : std::numeric_limits<float>::infinity());
    }
  }
}

double StockInWork::free_height(const FlatPlace& place, double around) {
  return highest(place, around, shapes_[tool_].radius.value());
}

// `inside`: the distance from the axis within which the cutter must touch nothing.
double StockInWork::highest(const FlatPlace& place, double around, double inside) {
  settle();
  measure(around, inside);
  const StockBlock& block = field_.block();
  const auto column = static_cast<std::ptrdiff_t>(std::floor((place.x + x0_ - block.low.x) / field_.cell()));
  const auto row = static_cast<std::ptrdiff_t>(std::floor((place.y + y0_ - block.low.y) / field_.cell()));
  const auto last_column = static_cast<std::ptrdiff_t>(field_.columns()) - 1;
  const auto last_row = static_cast<std::ptrdiff_t>(field_.rows()) - 1;
  float top = static_cast<float>(field_.bottom() - field_.top());
  for (std::ptrdiff_t y = std::max<std::ptrdiff_t>(0, row - reach_); y <= std::min(last_row, row + reach_); ++y) {
    const float* const cells = field_.below_top(static_cast<std::size_t>(y));
    const float* const shape = &heights_[static_cast<std::size_t>(std::abs(y - row) * (reach_ + 1))];
    for (std::ptrdiff_t x = std::max<std::ptrdiff_t>(0, column - reach_); x <= std::min(last_column, column + reach_);
         ++x) {
      top = std::max(top, cells[x] - shape[std::abs(x - column)]);
    }
  }
  return static_cast<double>(top) + field_.top();
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
      highest_place = std::max(highest_place, highest({here[Axis::x] - x0_, here[Axis::y] - y0_}, apart, radius / 2));
    }
    since = 0;
  }
  return highest_place;
}

}  // namespace passo
