#include "passo/cam/route.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "place_tree.hpp"

namespace passo {
namespace {

constexpr std::size_t neighbours_kept = 10;
constexpr double least_gain = 0.5;  // nm; less may be rounding
using Node = std::uint32_t;

// A fixed sequence of numbers that look random (splitmix64).
class FixedRandom {
 public:
  std::uint64_t below(std::uint64_t limit) {
    state_ += 0x9E3779B97F4A7C15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return (z ^ (z >> 31U)) % limit;
  }

 private:
  std::uint64_t state_ = 1;
};

// The order as a closed tour of all places, the end and the start. The way from the end to the start is so cheap that
// no change parts them for long.
class Tour {
 public:
  Tour(const std::vector<DrawnPoint>& places, DrawnPoint start, std::optional<DrawnPoint> end, std::uint64_t steps,
       const WorkProgress& progress)
      : points_(places), is_free_(!end), steps_(steps), steps_left_(steps), progress_(progress) {
    points_.push_back(end.value_or(start));
    points_.push_back(start);
    order_by_nearest();
    find_neighbours();
  }

  void improve() {
    queue_ = tour_;
    is_queued_.assign(size(), true);
    improve_queued();
    improve_by_chance();
  }

  std::vector<Node> order() const {
    std::vector<Node> order;
    order.reserve(size() - 2);
    const bool forwards = next(start()) != end();
    Node node = start();
    for (std::size_t i = 0; i + 2 < size(); ++i) {
      node = forwards ? next(node) : previous(node);
      order.push_back(node);
    }
    return order;
  }

 private:
  std::size_t size() const { return points_.size(); }
  Node start() const { return static_cast<Node>(size() - 1); }
  Node end() const { return static_cast<Node>(size() - 2); }
  Node next(Node node) const { return tour_[place_[node] + 1 == size() ? 0 : place_[node] + 1]; }
  Node previous(Node node) const { return tour_[place_[node] == 0 ? size() - 1 : place_[node] - 1]; }

  double way(Node a, Node b) {
    if (steps_left_ > 0) --steps_left_;
    constexpr double bound_together = -1e15;  // no few ways of a drawing are as long
    if (std::min(a, b) == end() && std::max(a, b) == start()) return bound_together;
    if (is_free_ && (a == end() || b == end())) return 0;  // the route may end anywhere
    return distance_nm(points_[a], points_[b]);
  }

  void order_by_nearest();
  void find_neighbours();
  void improve_queued();
  bool improve_two_ways(Node a);
  bool improve_by_shift(Node a);
  bool shift(Node a, Node last, Node p, Node q, Node u, Node v, bool turned);
  void improve_by_chance();
  void swap_pieces(Node p, Node a_first, Node a_last, Node b_first, Node b_last, Node q);
  void exchange(Node a, Node b, Node c, Node d);
  void reverse(std::size_t i, std::size_t j);
  void roll_back(std::size_t changes);
  void report() {
    constexpr std::uint32_t at_once = 1024;  // changes
    if (++changes_ % at_once != 0) return;
    progress_.update(1 - static_cast<double>(steps_left_) / static_cast<double>(steps_));
  }
  void queue(std::initializer_list<Node> nodes) {
    for (const Node node : nodes) {
      if (is_queued_[node]) continue;
      is_queued_[node] = true;
      queue_.push_back(node);
    }
  }

  std::vector<DrawnPoint> points_;
  bool is_free_;
  std::vector<std::array<Node, neighbours_kept>> near_;
  std::size_t kept_ = 0;  // neighbours of each node
  std::vector<Node> tour_;
  std::vector<std::uint32_t> place_;  // of each node in tour_
  std::vector<Node> queue_;           // nodes where a change may shorten the tour
  std::vector<bool> is_queued_;
  std::uint64_t steps_;
  std::uint64_t steps_left_;
  const WorkProgress& progress_;
  std::uint32_t changes_ = 0;
  double change_ = 0;                                           // of the tour's length since it was set to 0
  std::vector<std::pair<std::size_t, std::size_t>> reversals_;  // since it was cleared
};

void Tour::order_by_nearest() {
  PlaceTree left(points_);
  tour_ = {start()};
  tour_.reserve(size());
  left.forget(start());
  left.forget(end());
  while (tour_.size() + 1 < size()) {
    tour_.push_back(left.nearest_left(points_[tour_.back()]));
    left.forget(tour_.back());
  }
  tour_.push_back(end());
  place_.resize(size());
  for (std::uint32_t i = 0; i < size(); ++i) place_[tour_[i]] = i;
}

void Tour::find_neighbours() {
  PlaceTree all(points_);
  kept_ = std::min(neighbours_kept, size() - 1);
  near_.resize(size());
  std::vector<Node> found;
  for (Node node = 0; node < size(); ++node) {
    all.nearest(node, kept_, found);
    std::ranges::copy(found, near_[node].begin());
  }
}

// Turns the places of the tour from index i on to index j around, or all the others, if they are fewer: that is the
// same tour.
void Tour::reverse(std::size_t i, std::size_t j) {
  std::size_t inside = (j + size() - i) % size() + 1;
  if (2 * inside > size()) {
    std::swap(i, j);
    i = i + 1 == size() ? 0 : i + 1;
    j = j == 0 ? size() - 1 : j - 1;
    inside = size() - inside;
  }
  reversals_.emplace_back(i, j);
  steps_left_ -= std::min<std::uint64_t>(steps_left_, inside / 4);  // a place is moved faster than a way is measured
  for (std::size_t k = 0; k < inside / 2; ++k) {
    std::swap(tour_[i], tour_[j]);
    place_[tour_[i]] = static_cast<std::uint32_t>(i);
    place_[tour_[j]] = static_cast<std::uint32_t>(j);
    i = i + 1 == size() ? 0 : i + 1;
    j = j == 0 ? size() - 1 : j - 1;
  }
}

void Tour::roll_back(std::size_t changes) {
  while (reversals_.size() > changes) {
    const auto [i, j] = reversals_.back();
    reversals_.pop_back();
    reverse(i, j);
    reversals_.pop_back();
  }
}

// The ways a-b and c-d become a-c and b-d. In one direction of the tour, b follows a and d follows c.
void Tour::exchange(Node a, Node b, Node c, Node d) {
  change_ += way(a, c) + way(b, d) - way(a, b) - way(c, d);
  if (next(a) == b && next(c) == d) {
    reverse(place_[b], place_[c]);
  } else {
    reverse(place_[c], place_[b]);
  }
}

bool Tour::improve_two_ways(Node a) {
  for (const bool forwards : {true, false}) {
    const Node b = forwards ? next(a) : previous(a);
    const double way_ab = way(a, b);
    for (std::size_t k = 0; k < kept_; ++k) {
      const Node c = near_[a][k];
      const double way_ac = way(a, c);
      if (way_ac >= way_ab) break;
      const Node d = forwards ? next(c) : previous(c);
      if (c == b || d == a || way_ac + way(b, d) > way_ab + way(c, d) - least_gain) continue;
      exchange(a, b, c, d);
      queue({a, b, c, d});
      return true;
    }
  }
  return false;
}

// The piece from a to last, between p and q, goes between u and v, where v follows u in the direction from a to last:
// ... u a ... last v ..., or turned around.
bool Tour::shift(Node a, Node last, Node p, Node q, Node u, Node v, bool turned) {
  exchange(p, a, u, v);                  // p u ... q last ... a v
  if (u != q) exchange(p, u, q, last);   // p q ... u last ... a v
  if (!turned) exchange(u, last, a, v);  // p q ... u a ... last v
  queue({p, q, u, v, a, last});
  return true;
}

// A piece of one to three places that begins or ends with a goes beside one of a's neighbours.
bool Tour::improve_by_shift(Node a) {
  for (const bool forwards : {true, false}) {
    const auto after = [&](Node node) { return forwards ? next(node) : previous(node); };
    const auto before = [&](Node node) { return forwards ? previous(node) : next(node); };
    const Node p = before(a);
    std::array<Node, 3> piece = {a, a, a};
    Node last = a;
    for (std::size_t count = 1; count <= piece.size() && count + 3 < size(); ++count) {
      if (count > 1) last = after(last);
      if (last == p) break;
      piece[count - 1] = last;
      const Node q = after(last);
      if (q == p) break;
      const double gain = way(p, a) + way(last, q) - way(p, q);
      for (std::size_t k = 0; k < kept_ && gain > 0; ++k) {
        const Node c = near_[a][k];
        const double way_ac = way(a, c);
        if (way_ac >= gain) break;
        if (std::find(piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(count), c) !=
            piece.begin() + static_cast<std::ptrdiff_t>(count)) {
          continue;
        }
        const Node behind = after(c);
        if (c != p && way_ac + way(last, behind) - way(c, behind) < gain - least_gain) {
          return shift(a, last, p, q, c, behind, false);
        }
        const Node ahead = before(c);
        if (c != q && way_ac + way(last, ahead) - way(ahead, c) < gain - least_gain) {
          return shift(a, last, p, q, ahead, c, true);
        }
      }
    }
  }
  return false;
}

void Tour::improve_queued() {
  while (!queue_.empty() && steps_left_ > 0) {
    const Node node = queue_.back();
    queue_.pop_back();
    report();
    is_queued_[node] = false;
    while (steps_left_ > 0 && (improve_two_ways(node) || improve_by_shift(node))) {
    }
  }
  for (const Node node : queue_) is_queued_[node] = false;
  queue_.clear();
}

// p A B q becomes p B A q.
void Tour::swap_pieces(Node p, Node a_first, Node a_last, Node b_first, Node b_last, Node q) {
  exchange(p, a_first, b_last, q);
  if (b_first != b_last) exchange(p, b_last, b_first, a_last);
  if (a_first != a_last) exchange(b_last, a_last, a_first, q);
  queue({p, a_first, a_last, b_first, b_last, q});
}

void Tour::improve_by_chance() {
  constexpr std::size_t longest_piece = 50;
  const std::size_t most = std::min(longest_piece, (size() - 2) / 3);
  if (size() < 8 || most < 1) return;
  FixedRandom random;
  while (steps_left_ > 0) {
    reversals_.clear();
    change_ = 0;
    const auto after = [&](Node node, std::uint64_t count) {
      return tour_[(place_[node] + static_cast<std::size_t>(count)) % size()];
    };
    const Node p = tour_[random.below(size())];
    const Node a_first = next(p);
    const Node a_last = after(a_first, random.below(most));
    const Node b_first = next(a_last);
    const Node b_last = after(b_first, random.below(most));
    swap_pieces(p, a_first, a_last, b_first, b_last, next(b_last));
    improve_queued();
    if (change_ > -least_gain) roll_back(0);
  }
}

}  // namespace

std::vector<std::uint32_t> shorten_route(const std::vector<DrawnPoint>& places, DrawnPoint start,
                                         std::optional<DrawnPoint> end, std::uint64_t steps,
                                         const WorkProgress& progress) {
  if (places.empty()) return {};
  Tour tour(places, start, end, steps, progress);
  if (places.size() > 1) tour.improve();
  return tour.order();
}

std::uint64_t enough_steps(std::size_t places, std::uint64_t a_place) {
  const std::uint64_t for_few = std::max<std::uint64_t>(4'000, 8 * std::uint64_t{places} * places);
  return places * std::min(a_place, for_few);
}

double route_length(const std::vector<DrawnPoint>& places, const std::vector<std::uint32_t>& order, DrawnPoint start,
                    std::optional<DrawnPoint> end) {
  double length = 0;
  DrawnPoint at = start;
  for (const std::uint32_t index : order) {
    length += distance_nm(at, places[index]);
    at = places[index];
  }
  return end ? length + distance_nm(at, *end) : length;
}

}  // namespace passo
