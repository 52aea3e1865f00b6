#include "passo/laser/laser_grid.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "passo/cam/lettering.hpp"
#include "passo/laser/laser_lines.hpp"
#include "passo/laser/laser_raster.hpp"

namespace passo {
namespace {

class GridWriter {
 public:
  GridWriter(LaserProgram& program, const LaserGrid& grid, Diagnostics& diagnostics)
      : program_(program), grid_(grid), diagnostics_(diagnostics) {}

  void write() {
    write_labels();
    struct Cell {
      std::size_t column;
      std::size_t row;
    };
    std::vector<Cell> cells;
    for (std::size_t row = 0; row < grid_.rows; ++row) {
      for (std::size_t column = 0; column < grid_.columns; ++column) cells.push_back({column, row});
    }
    std::ranges::stable_sort(
        cells, {}, [&](const Cell& cell) { return percent(cell.column) / static_cast<double>(feed(cell.row).count); });
    for (const Cell& cell : cells) burn_cell(cell.column, cell.row);
  }

 private:
  static double value(double from, double to, std::size_t i, std::size_t count) {
    return count < 2 ? to : from + (to - from) * static_cast<double>(i) / static_cast<double>(count - 1);
  }
  // As in the labels: to 0.1 %, and to 1 mm/min.
  double percent(std::size_t column) const {
    return std::round(10 * value(grid_.least_percent, grid_.most_percent, column, grid_.columns)) / 10;
  }
  Nanometres feed(std::size_t row) const {
    const auto from = static_cast<double>(grid_.most_feed.count);
    const auto to = static_cast<double>(grid_.least_feed.count);
    return {std::llround(value(from, to, row, grid_.rows) / nanometres_per_mm) * 1'000'000};
  }
  DrawnPoint corner(std::size_t column, std::size_t row) const {
    const std::int64_t pitch = grid_.size.count + grid_.gap.count;
    return {{static_cast<std::int64_t>(column) * pitch}, {static_cast<std::int64_t>(row) * pitch}};
  }
  Mm letter_height() const {
    // Four digits fit into a cell and its gap.
    constexpr double largest = 2.5;
    return Mm(std::min(largest, to_mm(grid_.size + grid_.gap).value() / 5));
  }
  void write_labels();
  void add_label(EdgeLoops& lines, const std::string& text, DrawnPoint at, LetterAlign align);
  void burn_cell(std::size_t column, std::size_t row);

  LaserProgram& program_;
  const LaserGrid& grid_;
  Diagnostics& diagnostics_;
};

void GridWriter::add_label(EdgeLoops& lines, const std::string& text, DrawnPoint at, LetterAlign align) {
  Lettering lettering;
  lettering.text = text;
  lettering.height = letter_height();
  lettering.align = align;
  const Drawing drawing = letter_simplex(lettering, diagnostics_);
  for (const DrawnPath& path : drawing.paths) {
    std::vector<PathPoint> points = path.points;
    for (PathPoint& point : points) point.at = {point.at.x + at.x, point.at.y + at.y};
    (path.is_closed ? lines.loops : lines.open).push_back(std::move(points));
  }
}

void GridWriter::write_labels() {
  EdgeLoops lines;
  const Nanometres height = to_nanometres(letter_height());
  const Nanometres away{height.count / 2};
  for (std::size_t column = 0; column < grid_.columns; ++column) {
    const Nanometres middle{corner(column, 0).x.count + grid_.size.count / 2};
    add_label(lines, fmt::format("{:g}", percent(column)), {middle, {-away.count - height.count}}, LetterAlign::middle);
  }
  for (std::size_t row = 0; row < grid_.rows; ++row) {
    const std::int64_t base = corner(0, row).y.count + (grid_.size.count - height.count) / 2;
    add_label(lines, fmt::format("{:g}", to_mm(feed(row)).value()), {{-away.count}, {base}}, LetterAlign::right);
  }
  const Nanometres below{-away.count - 5 * height.count / 2 - away.count};
  const Nanometres right{corner(grid_.columns - 1, 0).x + grid_.size};
  add_label(lines, "power %", {right, below}, LetterAlign::right);
  const Nanometres above{corner(0, grid_.rows - 1).y + grid_.size + away};
  add_label(lines, "mm/min", {{-away.count}, above}, LetterAlign::right);
  burn_lines(program_, plan_laser_lines(lines, {.side = ProfileSide::on, .start = program_.at()}, diagnostics_),
             {.beam = grid_.label});
}

void GridWriter::burn_cell(std::size_t column, std::size_t row) {
  const BeamSetting beam{s_of(percent(column), program_.options().most_s), feed(row)};
  if (beam.s == 0) return;
  const DrawnPoint at = corner(column, row);
  if (!grid_.is_filled) {
    const std::vector<DrawnPoint> ring = rectangle({at, {at.x + grid_.size, at.y + grid_.size}});
    LaserLines lines;
    lines.paths.emplace_back();
    for (const DrawnPoint& point : ring) lines.paths.back().push_back({point, 0});
    lines.paths.back().push_back({ring.front(), 0});
    burn_lines(program_, lines, {.beam = beam, .passes = grid_.passes});
    return;
  }
  const auto side = static_cast<std::size_t>(std::max<std::int64_t>(1, grid_.size.count / grid_.line.count));
  const BeamCells cells{side, side, std::vector<std::uint32_t>(side * side, beam.s)};
  for (std::uint32_t pass = 0; pass < grid_.passes; ++pass) {
    burn_raster(program_, cells,
                {.origin = at,
                 .line = grid_.line,
                 .feed = beam.feed,
                 .overscan = overscan_for(beam.feed, program_.options().acceleration)});
  }
}

}  // namespace

void burn_grid(LaserProgram& program, const LaserGrid& grid, Diagnostics& diagnostics) {
  GridWriter(program, grid, diagnostics).write();
}

}  // namespace passo
