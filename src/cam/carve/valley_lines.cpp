#include "valley_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "level_path.hpp"

namespace passo {
namespace {

struct NodePlace {
  std::ptrdiff_t column = 0;
  std::ptrdiff_t row = 0;
};

constexpr std::array<NodePlace, 4> across_directions = {{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};
constexpr std::ptrdiff_t reach = 2;  // nodes; two slopes are measured over one and over two nodes

// The nodes at which a valley is sharpest, and how they follow each other.
class ValleyNodes {
 public:
  ValleyNodes(const TipSurface& surface, double least_bend)
      : map_(surface.map()), pitch_x_(surface.pitch_x()), pitch_y_(surface.pitch_y()), least_bend_(least_bend) {
    marks_.assign(map_.columns * map_.rows, 0);
    const auto last_column = static_cast<std::ptrdiff_t>(map_.columns) - reach - 1;
    const auto last_row = static_cast<std::ptrdiff_t>(map_.rows) - reach - 1;
    for (std::ptrdiff_t row = reach + 1; row < last_row; ++row) {
      for (std::ptrdiff_t column = reach + 1; column < last_column; ++column) {
        if (is_sharpest({column, row})) mark({column, row}) = 1;
      }
    }
  }

  // Calls act(nodes) for each chain of at least three nodes.
  template <class Act>
  void each_chain(const Act& act) {
    for (std::size_t i = 0; i < marks_.size(); ++i) {
      if (marks_[i] == 0) continue;
      const NodePlace seed{static_cast<std::ptrdiff_t>(i % map_.columns),
                           static_cast<std::ptrdiff_t>(i / map_.columns)};
      mark(seed) = 0;
      std::vector<NodePlace> chain = {seed};
      extend(chain);
      std::reverse(chain.begin(), chain.end());
      extend(chain);
      if (chain.size() >= 3) act(chain);
    }
  }

  FlatPlace place(const NodePlace& node) const {
    return {static_cast<double>(node.column - map_.margin_x) * pitch_x_,
            static_cast<double>(node.row - map_.margin_y) * pitch_y_};
  }

 private:
  char& mark(const NodePlace& node) {
    return marks_[static_cast<std::size_t>(node.row) * map_.columns + static_cast<std::size_t>(node.column)];
  }
  double height(std::ptrdiff_t column, std::ptrdiff_t row) const {
    return static_cast<double>(
        map_.heights[static_cast<std::size_t>(row) * map_.columns + static_cast<std::size_t>(column)]);
  }

  double bend(const NodePlace& node, const NodePlace& across, std::ptrdiff_t away, double length) const {
    const double here = height(node.column, node.row);
    const double after = height(node.column + across.column * away, node.row + across.row * away);
    const double before = height(node.column - across.column * away, node.row - across.row * away);
    const double way = length * static_cast<double>(away);
    return std::atan((after - here) / way) - std::atan((here - before) / way);
  }

  // How sharp the valley is; 0 if there is none. The slopes over a single node distinguish the foot of a wall from the
  // node next to it; those over two nodes find a valley between two nodes.
  double sharpness(const NodePlace& node, const NodePlace& across) const {
    const double length =
        std::hypot(static_cast<double>(across.column) * pitch_x_, static_cast<double>(across.row) * pitch_y_);
    const double here = height(node.column, node.row);
    const double after = height(node.column + across.column * reach, node.row + across.row * reach);
    const double before = height(node.column - across.column * reach, node.row - across.row * reach);
    // The least difference of two slopes with this bend; most nodes end here.
    if (after + before - 2 * here < 2 * std::tan(least_bend_ / 2) * length * static_cast<double>(reach)) return 0;
    const double wide = bend(node, across, reach, length);
    return wide < least_bend_ ? 0 : std::max(0.0, wide + bend(node, across, 1, length));
  }

  bool is_sharpest(const NodePlace& node) const {
    double most = 0;
    NodePlace best;
    for (const NodePlace& across : across_directions) {
      const double sharp = sharpness(node, across);
      if (sharp > most) most = sharp, best = across;
    }
    return most > 0 && most > sharpness({node.column - best.column, node.row - best.row}, best) &&
           most >= sharpness({node.column + best.column, node.row + best.row}, best);
  }

  // Adds nodes at the end, always the nearest one straight ahead. Other nodes next to the chain are used up.
  void extend(std::vector<NodePlace>& chain) {
    while (const std::optional<NodePlace> next = next_of(chain)) {
      const NodePlace& last = chain.back();
      for (std::ptrdiff_t row = -1; row <= 1; ++row) {
        for (std::ptrdiff_t column = -1; column <= 1; ++column) mark({last.column + column, last.row + row}) = 0;
      }
      mark(*next) = 0;
      chain.push_back(*next);
    }
  }

  std::optional<NodePlace> next_of(const std::vector<NodePlace>& chain) {
    constexpr std::size_t looks_back = 4;
    const NodePlace& last = chain.back();
    const NodePlace& before = chain[chain.size() > looks_back ? chain.size() - 1 - looks_back : 0];
    const double ahead_x = static_cast<double>(last.column - before.column);
    const double ahead_y = static_cast<double>(last.row - before.row);
    const double ahead = std::hypot(ahead_x, ahead_y);
    std::optional<NodePlace> best;
    double least = 1e9;
    for (std::ptrdiff_t row = -reach; row <= reach; ++row) {
      for (std::ptrdiff_t column = -reach; column <= reach; ++column) {
        const NodePlace node{last.column + column, last.row + row};
        const bool is_inside = node.column >= reach && node.row >= reach &&
                               node.column + reach < static_cast<std::ptrdiff_t>(map_.columns) &&
                               node.row + reach < static_cast<std::ptrdiff_t>(map_.rows);
        if (!is_inside || mark(node) == 0) continue;
        const double away = std::hypot(static_cast<double>(column), static_cast<double>(row));
        const double along = static_cast<double>(column) * ahead_x + static_cast<double>(row) * ahead_y;
        const double straight = ahead > 0 ? along / ahead / away : 1;
        constexpr double least_straight = 0.2;
        const double cost = away - straight;
        if (straight < least_straight || cost >= least) continue;
        least = cost;
        best = node;
      }
    }
    return best;
  }

  const TipMap& map_;
  double pitch_x_;
  double pitch_y_;
  double least_bend_;
  std::vector<char> marks_;
};

// Moves the points of a chain of nodes to where the valley is.
class ValleyLine {
 public:
  ValleyLine(const TipSurface& surface, std::vector<FlatPlace> points, bool is_closed)
      : surface_(surface),
        points_(std::move(points)),
        is_closed_(is_closed),
        pitch_(std::min(surface.pitch_x(), surface.pitch_y())) {}

  LevelLine take() {
    smooth();
    smooth();
    centre();
    smooth();
    smooth();
    smooth();
    keep_off_walls();
    LevelLine line{.points = std::move(points_), .is_closed = is_closed_};
    if (is_closed_) line.points.push_back(line.points.front());
    return line;
  }

 private:
  std::size_t index(std::size_t i, std::ptrdiff_t away) const {
    const auto count = static_cast<std::ptrdiff_t>(points_.size());
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(i) + away;
    return static_cast<std::size_t>(is_closed_ ? (at + count) % count : std::clamp<std::ptrdiff_t>(at, 0, count - 1));
  }

  void smooth() {
    std::vector<FlatPlace> smoothed = points_;
    for (std::size_t i = is_closed_ ? 0 : 1; i + (is_closed_ ? 0 : 1) < points_.size(); ++i) {
      const FlatPlace& before = points_[index(i, -1)];
      const FlatPlace& after = points_[index(i, 1)];
      smoothed[i] = {(before.x + 2 * points_[i].x + after.x) / 4, (before.y + 2 * points_[i].y + after.y) / 4};
    }
    points_ = std::move(smoothed);
  }

  // The unit vector along the line.
  FlatPlace ahead(std::size_t i) const {
    const FlatPlace& from = points_[index(i, -2)];
    const FlatPlace& to = points_[index(i, 2)];
    const double way = distance_between(from, to);
    return way > 0 ? FlatPlace{(to.x - from.x) / way, (to.y - from.y) / way} : FlatPlace{1, 0};
  }

  void centre() {
    std::vector<FlatPlace> centred = points_;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const FlatPlace along = ahead(i);
      const FlatPlace& here = points_[i];
      const auto at = [&](double out, double on) {
        return FlatPlace{here.x - along.y * out + along.x * on, here.y + along.x * out + along.y * on};
      };
      const double wide = 2 * pitch_;
      const double middle = surface_.at(here);
      const double left = std::atan((surface_.at(at(wide, 0)) - middle) / wide);
      const double right = std::atan((middle - surface_.at(at(-wide, 0))) / wide);
      const double tilt = std::tan((left + right) / 2);
      double best = 0;
      double least = 1e9;
      constexpr int steps = 12;
      for (int step = 0; step <= 2 * steps; ++step) {
        // 0, 1, -1, 2, -2 …: of equal places the nearest
        const double out = (step % 2 == 0 ? -1 : 1) * ((step + 1) / 2) * 1.5 * pitch_ / steps;
        const double half = 0.75 * pitch_;
        const double height = surface_.highest(at(out, -half), at(out, half)) - tilt * out;
        if (height < least - 1e-9) least = height, best = out;
      }
      centred[i] = at(best, 0);
    }
    points_ = std::move(centred);
  }

  // If the line climbs from one point to the next, both are moved downhill.
  void keep_off_walls() {
    constexpr double most_climb = 0.003;  // mm
    constexpr int tries = 8;
    for (int i = 0; i < tries; ++i) {
      bool has_moved = false;
      const std::size_t count = is_closed_ ? points_.size() : points_.size() - 1;
      for (std::size_t k = 0; k < count; ++k) {
        FlatPlace& from = points_[k];
        FlatPlace& to = points_[index(k, 1)];
        const double climb = surface_.highest(from, to) - std::max(surface_.at(from), surface_.at(to));
        if (climb <= most_climb) continue;
        const FlatPlace along = ahead(k);
        const FlatPlace middle{(from.x + to.x) / 2, (from.y + to.y) / 2};
        const double left = surface_.at({middle.x - along.y * pitch_, middle.y + along.x * pitch_});
        const double right = surface_.at({middle.x + along.y * pitch_, middle.y - along.x * pitch_});
        const double out = (left < right ? 1 : -1) * pitch_ / 4;
        for (FlatPlace* const point : {&from, &to}) *point = {point->x - along.y * out, point->y + along.x * out};
        has_moved = true;
      }
      if (!has_moved) return;
    }
  }

  const TipSurface& surface_;
  std::vector<FlatPlace> points_;
  bool is_closed_;
  double pitch_;
};

}  // namespace

std::vector<LevelLine> valley_lines(const TipSurface& surface, const ValleySearch& search) {
  std::vector<LevelLine> lines;
  ValleyNodes nodes(surface, search.least_bend.value);
  const double pitch = std::max(surface.pitch_x(), surface.pitch_y());
  nodes.each_chain([&](const std::vector<NodePlace>& chain) {
    std::vector<FlatPlace> points;
    for (const NodePlace& node : chain) points.push_back(nodes.place(node));
    constexpr std::size_t least_loop = 8;
    const bool is_closed = points.size() >= least_loop && distance_between(points.front(), points.back()) < 3 * pitch;
    const LevelLine line = ValleyLine(surface, std::move(points), is_closed).take();
    const double gap = search.least_length / 2;
    for (LevelLine& part : parts_of(line, search.wants, gap, search.least_length)) lines.push_back(std::move(part));
  });
  return lines;
}

}  // namespace passo
