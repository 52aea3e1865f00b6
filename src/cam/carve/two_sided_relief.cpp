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

  float best_parting() const {
    constexpr int steps = 100;
    float best = -deep_ / 2;
    double least = hidden(best);
    for (int i = 1; i < steps; ++i) {
      // From the middle outwards, so that of equal heights the middle one counts.
      const float out = deep_ / 2 * static_cast<float>((i + 1) / 2) / (steps / 2) * (i % 2 == 0 ? 1.0F : -1.0F);
      const float middle = std::clamp(-deep_ / 2 + out, -deep_ + web_, -web_);
      const double share = hidden(middle);
      if (share < least - 0.005) least = share, best = middle;
    }
    return best;
  }

  void put_web(SplitRelief& split, float middle) const {
    split.top = top_;
    split.bottom = bottom_;
    float through = std::max(-deep_, -deep_ - (middle + web_) - as_float(options_.through));
    if (options_.tab_width.value() <= 0) through = -deep_ - (middle - web_);
    // Where the part's edge lies deeper than the cut through the web, the trench must be as deep. It is empty there.
    const auto is_deeper = [&](const EdgePlace& place) { return -deep_ - place.low < through; };
    if (options_.tab_width.value() > 0 && std::any_of(edge_.begin(), edge_.end(), is_deeper)) through = -deep_;
    split.part.assign(top_.heights.size(), false);
    for (std::size_t row = 0; row < top_.rows; ++row) {
      for (std::size_t column = 0; column < top_.columns; ++column) {
        const std::size_t i = row * top_.columns + column;
        split.part[i] = is_part(column, row);
        if (split.part[i]) continue;
        split.top.heights[i] = grid_height(Mm(static_cast<double>(middle + web_)));
        float& below = split.bottom.heights[under(column, row)];
        below = std::max(below, grid_height(Mm(static_cast<double>(through))));
      }
    }
    widen(split, grid_height(Mm(static_cast<double>(middle + web_))), grid_height(Mm(static_cast<double>(through))));
  }

  void widen(SplitRelief& split, float web, float through) const {
    const std::size_t x = nodes(options_.trench, top_.pitch_x);
    const std::size_t y = nodes(options_.trench, top_.pitch_y);
    split.top = split.top.with_rim(x, y, web);
    split.bottom = split.bottom.with_rim(x, y, through);
  }

  static std::size_t nodes(Mm length, Mm pitch) { return static_cast<std::size_t>(std::ceil(length / pitch - 1e-6)); }

  // How many nodes lie before the part, on the way into the bottom from one of its sides. `never`: there is no part, or
  // the web does not meet its edge.
  struct Way {
    bool is_along_x = false;
    bool is_from_high = false;
  };
  static constexpr std::size_t never = std::numeric_limits<std::size_t>::max();
  std::size_t before_part(const Way& way, std::size_t across, float middle) const {
    const std::size_t count = way.is_along_x ? top_.columns : top_.rows;
    // A node of the bottom lies under the node of the top at the mirrored position, and vice versa.
    const auto place = [&](std::size_t i) {
      const std::size_t at = way.is_from_high ? count - 1 - i : i;
      const std::size_t node = way.is_along_x ? under(at, across) : under(across, at);
      return std::pair(node % top_.columns, node / top_.columns);
    };
    for (std::size_t i = 0; i + inside < count; ++i) {
      const auto [column, row] = place(i);
      if (!is_part(column, row)) continue;
      const auto [column_inside, row_inside] = place(i + inside);
      return is_part(column_inside, row_inside) && meets(place_at(column_inside, row_inside), middle) ? i : never;
    }
    return never;
  }

  // A tab for each side, where the part is nearest over the tab's width; of equal places the one in the middle.
  void put_tabs(SplitRelief& split, float middle) const {
    if (options_.tab_width.value() <= 0) return;
    const float level = grid_height(Mm(static_cast<double>(-deep_ - (middle - web_))));
    for (const Way& way : {Way{true, false}, Way{true, true}, Way{false, false}, Way{false, true}}) {
      const std::size_t count = way.is_along_x ? top_.rows : top_.columns;
      const std::size_t wide =
          std::min(count, nodes(options_.tab_width, way.is_along_x ? top_.pitch_y : top_.pitch_x) + 1);
      std::vector<std::size_t> ways;
      for (std::size_t i = 0; i < count; ++i) ways.push_back(before_part(way, i, middle));
      std::size_t best = count;
      std::size_t shortest = never;
      const auto from_middle = [&](std::size_t first) {
        return std::abs(static_cast<double>(first) - static_cast<double>(count - wide) / 2);
      };
      for (std::size_t first = 0; first + wide <= count; ++first) {
        const auto begin = ways.begin() + static_cast<std::ptrdiff_t>(first);
        const std::size_t longest = *std::max_element(begin, begin + static_cast<std::ptrdiff_t>(wide));
        const bool is_nearer =
            longest < shortest || (longest == shortest && best < count && from_middle(first) < from_middle(best));
        if (longest == never || !is_nearer) continue;
        shortest = longest;
        best = first;
      }
      if (best == count) continue;
      for (std::size_t i = best; i < best + wide; ++i) put_tab(split, way, i, ways[i], level);
      ++split.tabs;
    }
  }

  void put_tab(SplitRelief& split, const Way& way, std::size_t across, std::size_t length, float level) const {
    HeightGrid& grid = split.bottom;
    const std::size_t x = (grid.columns - top_.columns) / 2;
    const std::size_t y = (grid.rows - top_.rows) / 2;
    const std::size_t count = way.is_along_x ? grid.columns : grid.rows;
    const std::size_t trench = way.is_along_x ? x : y;
    for (std::size_t i = 0; i < trench + length; ++i) {
      const std::size_t at = way.is_from_high ? count - 1 - i : i;
      const std::size_t column = way.is_along_x ? at : across + x;
      const std::size_t row = way.is_along_x ? across + y : at;
      float& height = grid.heights[row * grid.columns + column];
      height = std::max(height, level);
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
