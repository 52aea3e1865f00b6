// PlaceTree: a k-d tree that finds the nearest points, and supports removal. Private to cam/.
//
// A search takes about log n steps, whatever the distribution of the points.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "passo/cam/drawing.hpp"

namespace passo {

class PlaceTree {
 public:
  explicit PlaceTree(const std::vector<DrawnPoint>& points) : points_(points), order_(points.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    build(1, 0, order_.size());
    where_.resize(points.size());
    for (std::uint32_t i = 0; i < order_.size(); ++i) where_[order_[i]] = i;
    is_there_.assign(points.size(), true);
  }

  // Finds the `count` points nearest to the point of this index, excluding itself, nearest first.
  void nearest(std::uint32_t index, std::size_t count, std::vector<std::uint32_t>& found) {
    best_.clear();
    wanted_ = count;
    search(1, 0, order_.size(), points_[index], index);
    found.clear();
    for (const auto& [square, place] : best_) found.push_back(place);
  }

  void forget(std::uint32_t index) {
    is_there_[index] = false;
    std::size_t low = 0;
    std::size_t high = order_.size();
    for (std::size_t node = 1;;) {
      --alive_[node];
      if (high - low <= leaf) return;
      const std::size_t middle = low + (high - low) / 2;
      node = 2 * node + (where_[index] < middle ? 0 : 1);
      (where_[index] < middle ? high : low) = middle;
    }
  }

  // Returns the index of the nearest remaining point; an index beyond the last if none remains.
  std::uint32_t nearest_left(DrawnPoint point) {
    best_.clear();
    wanted_ = 1;
    const auto none = std::numeric_limits<std::uint32_t>::max();
    search(1, 0, order_.size(), point, none);
    return best_.empty() ? none : best_.front().second;
  }

 private:
  static constexpr std::size_t leaf = 8;

  double coordinate(std::uint32_t place, bool is_y) const {
    return static_cast<double>(is_y ? points_[place].y.count : points_[place].x.count);
  }

  void build(std::size_t node, std::size_t low, std::size_t high) {
    if (alive_.size() <= node) {
      alive_.resize(2 * node + 2, 0);
      is_y_.resize(2 * node + 2, false);
      split_.resize(2 * node + 2, 0);
    }
    alive_[node] = high - low;
    if (high - low <= leaf) return;
    double least[2] = {1e300, 1e300};
    double most[2] = {-1e300, -1e300};
    for (std::size_t i = low; i < high; ++i) {
      for (const bool y : {false, true}) {
        least[y] = std::min(least[y], coordinate(order_[i], y));
        most[y] = std::max(most[y], coordinate(order_[i], y));
      }
    }
    const bool is_y = most[1] - least[1] > most[0] - least[0];
    is_y_[node] = is_y;
    const std::size_t middle = low + (high - low) / 2;
    const auto at = [this](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(low), at(middle), at(high), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(coordinate(a, is_y), a) < std::pair(coordinate(b, is_y), b);
    });
    split_[node] = coordinate(order_[middle], is_y);  // set now, because the upper half is reordered below
    build(2 * node, low, middle);
    build(2 * node + 1, middle, high);
  }

  void search(std::size_t node, std::size_t low, std::size_t high, DrawnPoint point, std::uint32_t excluded) {
    if (alive_[node] == 0) return;
    if (high - low <= leaf) {
      for (std::size_t i = low; i < high; ++i) {
        if (is_there_[order_[i]] && order_[i] != excluded) offer(order_[i], point);
      }
      return;
    }
    const std::size_t middle = low + (high - low) / 2;
    const double off = static_cast<double>(is_y_[node] ? point.y.count : point.x.count) - split_[node];
    for (const bool upper : {off >= 0, off < 0}) {
      const bool is_far = upper != (off >= 0);
      if (is_far && best_.size() == wanted_ && off * off > best_.back().first) return;
      search(2 * node + (upper ? 1 : 0), upper ? middle : low, upper ? high : middle, point, excluded);
    }
  }

  void offer(std::uint32_t place, DrawnPoint point) {
    const double dx = static_cast<double>(points_[place].x.count - point.x.count);
    const double dy = static_cast<double>(points_[place].y.count - point.y.count);
    const std::pair entry(dx * dx + dy * dy, place);
    if (best_.size() == wanted_) {
      if (!(entry < best_.back())) return;
      best_.pop_back();
    }
    best_.insert(std::ranges::upper_bound(best_, entry), entry);
  }

  const std::vector<DrawnPoint>& points_;
  std::vector<std::uint32_t> order_;  // point indices; the lower half of a node's range is at most its split value
  std::vector<std::uint32_t> where_;  // position of each point in order_
  std::vector<std::size_t> alive_;    // number of remaining points of each node
  std::vector<bool> is_y_;
  std::vector<double> split_;  // minimum coordinate of each node's upper half
  std::vector<bool> is_there_;
  std::size_t wanted_ = 0;
  std::vector<std::pair<double, std::uint32_t>> best_;  // squared distance and point index; nearest first
};

}  // namespace passo
