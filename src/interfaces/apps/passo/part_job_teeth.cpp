#include "part_job_teeth.hpp"

#include <algorithm>
#include <cmath>

namespace passo {
namespace {

constexpr double least_hit = 0.005;  // mm; less is rounding

double level_distance(const Vector3& a, const Vector3& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

// The rows or columns whose centres are within `radius` of `at`.
struct CellRange {
  std::size_t first = 0;
  std::size_t end = 0;
};
CellRange cells_within(double at, double radius, double low, double cell, std::size_t count) {
  const double first = std::ceil((at - radius - low) / cell - 0.5);
  const double end = std::floor((at + radius - low) / cell - 0.5) + 1;
  const auto limited = [&](double value) {
    return static_cast<std::size_t>(std::clamp(value, 0.0, static_cast<double>(count)));
  };
  return {limited(first), limited(end)};
}

}  // namespace

void TeethWay::add(const Curve& curve, const Vector3& zero, std::uint32_t line, std::size_t tool,
                   const ToolShape& shape) {
  tool_ = tool;
  const double length = curve.length().value();
  // Discs at this distance leave scallops of at most 1/128 of the radius between them.
  const double step = std::clamp(shape.cutter.radius.value() / 4, 0.05, 0.5);
  const auto count = static_cast<std::size_t>(std::clamp(std::ceil(length / step), 1.0, 1e5));
  for (std::size_t i = 0; i <= count; ++i) {
    const Mm s(length * static_cast<double>(i) / static_cast<double>(count));
    points_.push_back({Vector3::of(curve.at(s)) - zero, line});
  }
  // The arcs that lead in and out are level; those of the thread rise or fall.
  const double rise = std::abs(curve.end()[Axis::z] - curve.start()[Axis::z]);
  if (curve.shape() != Curve::Shape::arc || rise < 1e-6) return;
  const Curve::ArcData& arc = curve.arc_data();
  const double radius = std::min(arc.start_radius, arc.end_radius);
  nearest_ = axis_ ? std::min(nearest_, radius) : radius;
  axis_ = Vector3{arc.first_center, arc.second_center, 0} - Vector3{zero.x, zero.y, 0};
}

TeethWay::Boss TeethWay::boss(const ToolShape& shape) const {
  if (!axis_) return {};
  return {*axis_, nearest_ - shape.neck_radius.value()};
}

std::optional<TeethHit> TeethWay::take_hit(const HeightField& field, const ToolShape& shape) {
  const Boss own = boss(shape);
  const double radius = shape.cutter.radius.value();
  // A cell's height is that of its centre.
  const double inside = own.inside + field.cell();
  TeethHit hit{.axis = own.axis};
  for (const Sample& sample : points_) {
    hit.reach = std::max(hit.reach, level_distance(sample.at, own.axis) + radius);
    const StockBlock& block = field.block();
    const CellRange rows = cells_within(sample.at.y, radius, block.low.y, field.cell(), field.rows());
    const CellRange columns = cells_within(sample.at.x, radius, block.low.x, field.cell(), field.columns());
    for (std::size_t row = rows.first; row < rows.end; ++row) {
      for (std::size_t column = columns.first; column < columns.end; ++column) {
        const double depth = field.height(column, row) - sample.at.z;
        if (depth <= std::max(hit.depth, least_hit)) continue;
        const Vector3 cell{field.x_of(column), field.y_of(row), field.height(column, row)};
        if (level_distance(cell, sample.at) > radius) continue;
        if (axis_ && level_distance(cell, own.axis) <= inside) continue;
        hit.depth = depth;
        hit.place = cell;
        hit.line = sample.line;
      }
    }
  }
  points_.clear();
  axis_.reset();
  if (hit.depth <= 0) return std::nullopt;
  return hit;
}

}  // namespace passo
