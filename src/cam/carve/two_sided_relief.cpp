#include "passo/carve/two_sided_relief.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace passo {
namespace {

// A place where the part meets the trench: its lowest and its highest point there.
struct EdgePlace {
  float low = 0;
  float high = 0;
};

class Splitter {
 public:
  Splitter(const HeightGrid& top, const HeightGrid& bottom, Mm high, const SplitOptions& options)
      : top_(top),
        bottom_(bottom),
        options_(options),
        deep_(-grid_height(high * -1)),
        web_(as_float(options.tab_height) / 2) {}

  SplitRelief split() {
    find_edge();
    SplitRelief split;
    const float middle = options_.parting ? -as_float(*options_.parting) : best_parting();
    split.parting = Mm(-static_cast<double>(middle));
    split.hidden = hidden(middle);
    split.has_web = options_.tab_width.value() <= 0 || blocked(middle) <= little;
    put_web(split, middle);
    put_tabs(split, middle);
    put_frame(split);
    return split;
  }

 private:
  static float as_float(Mm length) { return static_cast<float>(length.value()); }
  bool is_part(std::size_t column, std::size_t row) const {
    return top_.at(column, row) > -deep_ && bottom_.heights[under(column, row)] > -deep_;
  }
  // The node of the bottom that lies under a node of the top.
  std::size_t under(std::size_t column, std::size_t row) const {
    const bool is_x = options_.flip == StockFlip::left_to_right;
    const std::size_t i = is_x ? top_.columns - 1 - column : column;
    const std::size_t j = is_x ? row : top_.rows - 1 - row;
    return j * top_.columns + i;
  }

  EdgePlace place_at(std::size_t column, std::size_t row) const {
    return {-deep_ - bottom_.heights[under(column, row)], top_.at(column, row)};
  }

  // Walls are some nodes wider on the grid than on the part, so the edge is measured some nodes farther inside.
  void find_edge() {
    const auto columns = static_cast<std::ptrdiff_t>(top_.columns);
    const auto rows = static_cast<std::ptrdiff_t>(top_.rows);
    const auto is_part_at = [&](std::ptrdiff_t x, std::ptrdiff_t y) {
      return x >= 0 && y >= 0 && x < columns && y < rows &&
             is_part(static_cast<std::size_t>(x), static_cast<std::size_t>(y));
    };
    for (std::ptrdiff_t y = 0; y < rows; ++y) {
      for (std::ptrdiff_t x = 0; x < columns; ++x) {
        if (!is_part_at(x, y)) continue;
        for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
          if (is_part_at(x + dx, y + dy) || !is_part_at(x - inside * dx, y - inside * dy)) continue;
          const auto column = static_cast<std::size_t>(x - inside * dx);
          const auto row = static_cast<std::size_t>(y - inside * dy);
          edge_.push_back(place_at(column, row));
        }
      }
    }
  }

  // Whether the web ends at the part's edge, and not above or below it.
  bool meets(const EdgePlace& place, float middle) const {
    return place.high >= middle + web_ && place.low <= middle - web_;
  }
  double hidden(float middle) const {
    if (edge_.empty()) return 0;
    const auto misses = [&](const EdgePlace& place) { return !meets(place, middle); };
    return static_cast<double>(std::count_if(edge_.begin(), edge_.end(), misses)) / static_cast<double>(edge_.size());
  }

  // The share of the edge that the top cannot be cut down to, because the web is in the way.
  double blocked(float middle) const {
    if (edge_.empty()) return 0;
    const auto is_below = [&](const EdgePlace& place) { return place.high < middle + web_ - slack; };
    return static_cast<double>(std::count_if(edge_.begin(), edge_.end(), is_below)) / static_cast<double>(edge_.size());
  }
  // How far the web goes beyond the edge, mm, on average. Above the edge it counts far more, because the top cannot be
  // cut down to what it hides; below the edge, the bottom cuts the web off.
  double beyond_edge(float middle) const {
    double sum = 0;
    for (const EdgePlace& place : edge_) {
      sum += 100 * std::max(0.0, static_cast<double>(middle + web_ - place.high));
      sum += std::max(0.0, static_cast<double>(place.low - (middle - web_)));
    }
    return sum / static_cast<double>(std::max<std::size_t>(1, edge_.size()));
  }

  // The height with the lowest `cost`. From the middle outwards, so that of equal heights the middle one counts.
  template <class Cost>
  float cheapest(const Cost& cost, double least_gain) const {
    constexpr int steps = 100;
    float best = -deep_ / 2;
    double least = cost(best);
    for (int i = 1; i <= steps; ++i) {
      const float out = deep_ / 2 * static_cast<float>((i + 1) / 2) / (steps / 2) * (i % 2 == 0 ? 1.0F : -1.0F);
      const float highest = -web_ - as_float(options_.through);  // so that the bottom can be cut through the web
      const float middle = std::min(highest, std::max(-deep_ / 2 + out, -deep_ + web_));
      const double here = cost(middle);
      if (here < least - least_gain) least = here, best = middle;
    }
    return best;
  }
  float best_parting() const {
    const float even = cheapest([this](float middle) { return hidden(middle); }, 0.005);
    // The edge of an egg or a pyramid is thinner than the web.
    return hidden(even) <= little ? even : cheapest([this](float middle) { return beyond_edge(middle); }, 1e-4);
  }

  void put_web(SplitRelief& split, float middle) const {
    split.top = top_;
    split.bottom = bottom_;
    float through = std::max(-deep_, -deep_ - (middle + web_) - as_float(options_.through));
    if (options_.tab_width.value() <= 0) through = -deep_ - (middle - web_);
    // Where the part's edge lies deeper than the cut through the web, the trench must be as deep. It is empty there.
    const auto is_deeper = [&](const EdgePlace& place) { return -deep_ - place.low < through; };
    if (options_.tab_width.value() > 0 && std::any_of(edge_.begin(), edge_.end(), is_deeper)) through = -deep_;
    // Without a web, both sides are cut down to the lowest height of the part.
    const float floor = split.has_web ? grid_height(Mm(static_cast<double>(middle + web_))) : -deep_;
    split.part.assign(top_.heights.size(), false);
    for (std::size_t row = 0; row < top_.rows; ++row) {
      for (std::size_t column = 0; column < top_.columns; ++column) {
        const std::size_t i = row * top_.columns + column;
        split.part[i] = is_part(column, row);
        if (split.part[i]) continue;
        split.top.heights[i] = floor;
        float& below = split.bottom.heights[under(column, row)];
        below = std::max(below, grid_height(Mm(static_cast<double>(through))));
      }
    }
    widen(split, floor, grid_height(Mm(static_cast<double>(through))));
  }

  void widen(SplitRelief& split, float web, float through) const {
    const std::size_t x = nodes(options_.trench, top_.pitch_x);
    const std::size_t y = nodes(options_.trench, top_.pitch_y);
    split.top = split.top.with_rim(x, y, web);
    split.bottom = split.bottom.with_rim(x, y, through);
  }

  static std::size_t nodes(Mm length, Mm pitch) { return static_cast<std::size_t>(std::ceil(length / pitch - 1e-6)); }

  // A line of nodes from one side of the bottom into it.
  struct Way {
    bool is_along_x = false;
    bool is_from_high = false;
  };
  // The nodes of a tab: `outside` of the part, and as many as lie before the place where the part is as thick as the
  // tab. `never`: there is no such place.
  struct TabLength {
    std::size_t outside = never;
    std::size_t all = never;
  };
  static constexpr std::size_t never = std::numeric_limits<std::size_t>::max();
  TabLength tab_on(const Way& way, std::size_t across, float middle) const {
    const std::size_t count = way.is_along_x ? top_.columns : top_.rows;
    // A node of the bottom lies under the node of the top at the mirrored position, and vice versa.
    const auto place = [&](std::size_t i) {
      const std::size_t at = way.is_from_high ? count - 1 - i : i;
      const std::size_t node = way.is_along_x ? under(at, across) : under(across, at);
      return std::pair(node % top_.columns, node / top_.columns);
    };
    const auto is_part_at = [&](std::size_t i) {
      const auto [column, row] = place(i);
      return is_part(column, row);
    };
    const auto meets_at = [&](std::size_t i) {
      const auto [column, row] = place(i);
      return meets(place_at(column, row), middle);
    };
    std::size_t first = 0;
    while (first < count && !is_part_at(first)) ++first;
    const std::size_t most = nodes(options_.tab_height * 2.5, way.is_along_x ? top_.pitch_x : top_.pitch_y);
    for (std::size_t on = 0; on <= most && first + on + inside < count; ++on) {
      if (!is_part_at(first + on)) break;
      const std::size_t looked = first + on + inside;
      if (is_part_at(looked) && meets_at(looked)) return {first, first + on};
    }
    return {};
  }

  // A tab for each side, where the part is nearest over the tab's width; of equal places the one in the middle.
  void put_tabs(SplitRelief& split, float middle) const {
    if (options_.tab_width.value() <= 0) return;
    for (const Way& way : {Way{true, false}, Way{true, true}, Way{false, false}, Way{false, true}}) {
      const std::size_t count = way.is_along_x ? top_.rows : top_.columns;
      const std::size_t wide =
          std::min(count, nodes(options_.tab_width, way.is_along_x ? top_.pitch_y : top_.pitch_x) + 1);
      std::vector<TabLength> ways;
      for (std::size_t i = 0; i < count; ++i) ways.push_back(tab_on(way, i, middle));
      std::size_t best = count;
      std::size_t shortest = never;
      const auto from_middle = [&](std::size_t first) {
        return std::abs(static_cast<double>(first) - static_cast<double>(count - wide) / 2);
      };
      for (std::size_t first = 0; first + wide <= count; ++first) {
        const auto begin = ways.begin() + static_cast<std::ptrdiff_t>(first);
        const auto is_shorter = [](const TabLength& a, const TabLength& b) { return a.all < b.all; };
        const std::size_t longest = std::max_element(begin, begin + static_cast<std::ptrdiff_t>(wide), is_shorter)->all;
        const bool is_nearer =
            longest < shortest || (longest == shortest && best < count && from_middle(first) < from_middle(best));
        if (longest == never || !is_nearer) continue;
        shortest = longest;
        best = first;
      }
      if (best == count) continue;
      for (std::size_t i = best; i < best + wide; ++i) {
        put_tab(split, way, i, ways[i].all, middle);
        const Mm on_part =
            (way.is_along_x ? top_.pitch_x : top_.pitch_y) * static_cast<double>(ways[i].all - ways[i].outside);
        split.on_part = std::max(split.on_part, on_part);
      }
      ++split.tabs;
    }
  }

  // On both sides: where there is no web, and on the part where it is thinner than the tab.
  void put_tab(SplitRelief& split, const Way& way, std::size_t across, std::size_t length, float middle) const {
    const float upper = grid_height(Mm(static_cast<double>(middle + web_)));
    const float lower = grid_height(Mm(static_cast<double>(-deep_ - (middle - web_))));
    HeightGrid& grid = split.bottom;
    const std::size_t x = (grid.columns - top_.columns) / 2;
    const std::size_t y = (grid.rows - top_.rows) / 2;
    const std::size_t count = way.is_along_x ? grid.columns : grid.rows;
    const std::size_t trench = way.is_along_x ? x : y;
    const auto raise = [](float& height, float level) { height = std::max(height, level); };
    for (std::size_t i = 0; i < trench + length; ++i) {
      const std::size_t at = way.is_from_high ? count - 1 - i : i;
      const std::size_t column = way.is_along_x ? at : across + x;
      const std::size_t row = way.is_along_x ? across + y : at;
      raise(grid.heights[row * grid.columns + column], lower);
      const bool is_x = options_.flip == StockFlip::left_to_right;
      const std::size_t above_column = is_x ? grid.columns - 1 - column : column;
      const std::size_t above_row = is_x ? row : grid.rows - 1 - row;
      raise(split.top.heights[above_row * grid.columns + above_column], upper);
    }
  }

  void put_frame(SplitRelief& split) const {
    constexpr std::size_t wide = 2;  // nodes; cutters stay within the grid, so two are enough
    const std::size_t x = (split.top.columns - top_.columns) / 2 + wide;
    const std::size_t y = (split.top.rows - top_.rows) / 2 + wide;
    split.top = split.top.with_rim(wide, wide, 0);
    split.bottom = split.bottom.with_rim(wide, wide, 0);
    split.beside_x = top_.pitch_x * static_cast<double>(x);
    split.beside_y = top_.pitch_y * static_cast<double>(y);
    std::vector<bool> part(split.top.heights.size(), false);
    for (std::size_t row = 0; row < top_.rows; ++row) {
      for (std::size_t column = 0; column < top_.columns; ++column) {
        part[(row + y) * split.top.columns + column + x] = split.part[row * top_.columns + column];
      }
    }
    split.part = std::move(part);
  }

  static constexpr std::ptrdiff_t inside = 4;  // nodes
  static constexpr double little = 0.02;       // of the edge
  static constexpr float slack = 0.02F;        // mm; heights of models are slightly too high on curved faces
  const HeightGrid& top_;
  const HeightGrid& bottom_;
  const SplitOptions& options_;
  float deep_;
  float web_;  // half of its thickness
  std::vector<EdgePlace> edge_;
};

}  // namespace

SplitRelief split_relief(const HeightGrid& top, const HeightGrid& bottom, Mm high, const SplitOptions& options) {
  return Splitter(top, bottom, high, options).split();
}

}  // namespace passo
