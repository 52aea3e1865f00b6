#include "level_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace passo {

TipSurface::Cell TipSurface::cell(std::size_t column, std::size_t row) const {
  const float* const low = &map_.heights[row * map_.columns + column];
  const float* const high = low + map_.columns;
  return {low[0], low[1], high[0], high[1]};
}

double TipSurface::at(const FlatPlace& place) const {
  const auto last_column = static_cast<double>(map_.columns - 1);
  const auto last_row = static_cast<double>(map_.rows - 1);
  const double across = std::clamp(place.x / pitch_x_ + static_cast<double>(map_.margin_x), 0.0, last_column);
  const double up = std::clamp(place.y / pitch_y_ + static_cast<double>(map_.margin_y), 0.0, last_row);
  const std::size_t column = std::min(static_cast<std::size_t>(across), map_.columns - 2);
  const std::size_t row = std::min(static_cast<std::size_t>(up), map_.rows - 2);
  const Cell here = cell(column, row);
  const double u = across - static_cast<double>(column);
  const double v = up - static_cast<double>(row);
  return (1 - v) * ((1 - u) * here.low_left + u * here.low_right) +
         v * ((1 - u) * here.high_left + u * here.high_right);
}

// Cell by cell: along a straight way a bilinear patch is a parabola.
double TipSurface::highest(const FlatPlace& from, const FlatPlace& to) const {
  const auto clamped = [&](const FlatPlace& place) {
    return FlatPlace{
        std::clamp(place.x / pitch_x_ + static_cast<double>(map_.margin_x), 0.0, static_cast<double>(map_.columns - 1)),
        std::clamp(place.y / pitch_y_ + static_cast<double>(map_.margin_y), 0.0, static_cast<double>(map_.rows - 1))};
  };
  const FlatPlace a = clamped(from);
  const FlatPlace b = clamped(to);
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const auto cell_of = [](double at, double ahead, std::size_t count) {
    const double cell = ahead < 0 ? std::ceil(at) - 1 : std::floor(at);
    return std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(cell), 0, static_cast<std::ptrdiff_t>(count) - 2);
  };
  std::ptrdiff_t column = cell_of(a.x, dx, map_.columns);
  std::ptrdiff_t row = cell_of(a.y, dy, map_.rows);
  const auto next_at = [](double from_here, double ahead, std::ptrdiff_t in_cell) {
    constexpr double never = std::numeric_limits<double>::infinity();
    if (ahead == 0) return never;
    return (static_cast<double>(in_cell + (ahead > 0 ? 1 : 0)) - from_here) / ahead;
  };
  double highest = -std::numeric_limits<double>::infinity();
  double share = 0;
  while (true) {
    const double next_x = next_at(a.x, dx, column);
    const double next_y = next_at(a.y, dy, row);
    const double end = std::clamp(std::min(next_x, next_y), share, 1.0);
    const Cell here = cell(static_cast<std::size_t>(column), static_cast<std::size_t>(row));
    const double twist = here.low_left - here.low_right - here.high_left + here.high_right;
    const double along_u = here.low_right - here.low_left;
    const double along_v = here.high_left - here.low_left;
    const double u = a.x + dx * share - static_cast<double>(column);
    const double v = a.y + dy * share - static_cast<double>(row);
    const double start = here.low_left + along_u * u + along_v * v + twist * u * v;
    const double slope = along_u * dx + along_v * dy + twist * (u * dy + v * dx);
    const double bend = twist * dx * dy;
    const auto height = [&](double t) { return start + slope * t + bend * t * t; };
    const double way = end - share;
    highest = std::max({highest, start, height(way)});
    if (bend < 0 && slope > 0) highest = std::max(highest, height(std::min(way, slope / (-2 * bend))));
    if (end >= 1) return highest;
    share = end;
    std::ptrdiff_t& index = next_x <= next_y ? column : row;
    const std::size_t count = next_x <= next_y ? map_.columns : map_.rows;
    index += (next_x <= next_y ? dx : dy) > 0 ? 1 : -1;
    if (index < 0 || index > static_cast<std::ptrdiff_t>(count) - 2) return highest;
  }
}

LevelLines::LevelLines(const TipMap& map, Mm pitch_x, Mm pitch_y)
    : map_(map), pitch_x_(pitch_x.value()), pitch_y_(pitch_y.value()), blocks_((map.columns - 1 + block - 1) / block) {
  lowest_.assign(blocks_ * (map.rows - 1), std::numeric_limits<float>::infinity());
  highest_.assign(lowest_.size(), -std::numeric_limits<float>::infinity());
  for (std::size_t row = 0; row + 1 < map.rows; ++row) {
    for (std::size_t i = 0; i < blocks_; ++i) {
      const std::size_t end = std::min((i + 1) * block + 1, map.columns);
      for (const std::size_t y : {row, row + 1}) {
        const auto [low, high] =
            std::minmax_element(&map.heights[y * map.columns + i * block], &map.heights[y * map.columns + end - 1] + 1);
        lowest_[row * blocks_ + i] = std::min(lowest_[row * blocks_ + i], *low);
        highest_[row * blocks_ + i] = std::max(highest_[row * blocks_ + i], *high);
      }
    }
  }
}

LevelLines::Corners LevelLines::corners(std::size_t column, std::size_t row) const {
  const float* const low = &map_.heights[row * map_.columns + column];
  const float* const high = low + map_.columns;
  return {low[0], low[1], high[1], high[0]};
}

bool LevelLines::has_line(std::size_t block_of_row, std::size_t row) const {
  const std::size_t i = row * blocks_ + block_of_row;
  return lowest_[i] <= height_ && highest_[i] > height_;
}

// Along the cell's rim, counterclockwise, the map rises through the height: a line with the high side on its right
// comes in there.
bool LevelLines::is_entry(const Place& place) const {
  const Corners at = corners(place.column, place.row);
  const auto edge = static_cast<std::size_t>(place.edge);
  return at[edge] <= height_ && at[(edge + 1) % 4] > height_;
}

int LevelLines::exit_of(const Place& entry) const {
  const Corners at = corners(entry.column, entry.row);
  const auto is_exit = [&](int edge) {
    const auto i = static_cast<std::size_t>(edge);
    return at[i] > height_ && at[(i + 1) % 4] <= height_;
  };
  const int next = (entry.edge + 1) % 4;
  const int before = (entry.edge + 3) % 4;
  const int across = (entry.edge + 2) % 4;
  if (!is_exit(next) || !is_exit(before)) return is_exit(next) ? next : is_exit(before) ? before : across;
  // Four crossings. Where the saddle between them is low, each high corner is alone.
  const double twist = static_cast<double>(at[0]) - at[1] + at[2] - at[3];
  const double saddle = (static_cast<double>(at[0]) * at[2] - static_cast<double>(at[1]) * at[3]) / twist;
  return saddle <= static_cast<double>(height_) ? next : before;
}

// Into the cell beyond the edge, whose name for the edge it gets. False: there is none.
bool LevelLines::step(Place& place) const {
  switch (place.edge) {
    case 0:
      if (place.row == 0) return false;
      --place.row;
      break;
    case 1:
      if (place.column + 2 >= map_.columns) return false;
      ++place.column;
      break;
    case 2:
      if (place.row + 2 >= map_.rows) return false;
      ++place.row;
      break;
    default:
      if (place.column == 0) return false;
      --place.column;
  }
  place.edge = (place.edge + 2) % 4;
  return true;
}

std::size_t LevelLines::number_of(const Place& place) const {
  const std::size_t column = place.column + (place.edge == 1 ? 1 : 0);
  const std::size_t row = place.row + (place.edge == 2 ? 1 : 0);
  return 2 * (row * map_.columns + column) + static_cast<std::size_t>(place.edge % 2);
}

FlatPlace LevelLines::crossing(const Place& place) const {
  const Corners at = corners(place.column, place.row);
  // The lower or the left end first: so both cells of an edge find the same place.
  const auto first = static_cast<std::size_t>(place.edge < 2 ? place.edge : (place.edge + 1) % 4);
  const auto second = static_cast<std::size_t>(place.edge < 2 ? place.edge + 1 : place.edge);
  const double from = at[first];
  const double share = (static_cast<double>(height_) - from) / (static_cast<double>(at[second]) - from);
  const double column = static_cast<double>(place.column) + (place.edge == 1 ? 1 : place.edge == 3 ? 0 : share);
  const double row = static_cast<double>(place.row) + (place.edge == 2 ? 1 : place.edge == 0 ? 0 : share);
  return {(column - static_cast<double>(map_.margin_x)) * pitch_x_,
          (row - static_cast<double>(map_.margin_y)) * pitch_y_};
}

// Where the chord from the entry to the exit would lie above the height, the place at which the tangents of the
// hyperbola meet. From its middle, (x - x0)(y - y0) is the same all along a hyperbola: then each coordinate of that
// place is the harmonic mean of those of the ends.
void LevelLines::add_tangents(const Place& entry, int exit, LevelLine& line) const {
  const Corners at = corners(entry.column, entry.row);
  const double twist = static_cast<double>(at[0]) - at[1] + at[2] - at[3];
  const FlatPlace from = crossing(entry);
  const FlatPlace to = crossing({entry.column, entry.row, exit});
  const double du = (to.x - from.x) / pitch_x_;
  const double dv = (to.y - from.y) / pitch_y_;
  if (-twist * du * dv / 4 <= slack) return;
  const double left = static_cast<double>(entry.column) - static_cast<double>(map_.margin_x);
  const double low = static_cast<double>(entry.row) - static_cast<double>(map_.margin_y);
  const double x0 = left - (static_cast<double>(at[3]) - at[0]) / twist;
  const double y0 = low - (static_cast<double>(at[1]) - at[0]) / twist;
  const auto mean = [](double a, double b, double middle) {
    const double u = a - middle;
    const double v = b - middle;
    return u + v == 0 ? a : middle + 2 * u * v / (u + v);
  };
  line.points.push_back({mean(from.x / pitch_x_, to.x / pitch_x_, x0) * pitch_x_,
                         mean(from.y / pitch_y_, to.y / pitch_y_, y0) * pitch_y_});
}

void LevelLines::follow(Place entry, const std::function<void(LevelLine&&)>& act) {
  LevelLine line;
  const std::size_t first = number_of(entry);
  line.points.push_back(crossing(entry));
  seen_[first] = true;
  while (true) {
    const int exit = exit_of(entry);
    add_tangents(entry, exit, line);
    entry.edge = exit;
    line.points.push_back(crossing(entry));
    const std::size_t number = number_of(entry);
    if (number == first) {
      line.is_closed = true;
      break;
    }
    seen_[number] = true;
    if (!step(entry)) break;
  }
  act(std::move(line));
}

void LevelLines::trace(float height, const std::function<void(LevelLine&&)>& act) {
  height_ = height;
  seen_.assign(2 * map_.columns * map_.rows, false);
  const std::size_t columns = map_.columns - 1;
  const std::size_t rows = map_.rows - 1;
  const auto begin = [&](const Place& place) {
    if (is_entry(place) && !seen_[number_of(place)]) follow(place, act);
  };
  // Lines that come in over the map's edge first: followed from elsewhere they would be cut in two.
  for (std::size_t column = 0; column < columns; ++column) {
    begin({column, 0, 0});
    begin({column, rows - 1, 2});
  }
  for (std::size_t row = 0; row < rows; ++row) {
    begin({0, row, 3});
    begin({columns - 1, row, 1});
  }
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t i = 0; i < blocks_; ++i) {
      if (!has_line(i, row)) continue;
      // Each closed line goes through an upright edge, or comes in over a level one.
      for (std::size_t column = i * block; column < std::min((i + 1) * block, columns); ++column) {
        for (const int edge : {0, 3}) begin({column, row, edge});
      }
    }
  }
}

}  // namespace passo
