#include "piece_order.hpp"

#include <algorithm>
#include <utility>

namespace passo {
namespace {

constexpr double least_piece_gain = 1;  // nm; less may be rounding

class PieceOrderer {
 public:
  PieceOrderer(const std::vector<RoutePiece>& pieces, DrawnPoint start, std::optional<DrawnPoint> end,
               std::uint64_t steps)
      : pieces_(pieces), first_(start), last_(end), steps_left_(steps) {
    for (std::uint32_t i = 0; i < pieces.size(); ++i) order_.push_back({i});
  }

  std::vector<PlacedPiece> order() {
    bool is_shorter = true;
    while (is_shorter && steps_left_ > 0) {
      is_shorter = reverse_parts();
      is_shorter = move_pieces() || is_shorter;
    }
    return std::move(order_);
  }

 private:
  std::size_t size() const { return order_.size(); }
  DrawnPoint start(PlacedPiece at) const { return at.is_turned ? pieces_[at.piece].end : pieces_[at.piece].start; }
  DrawnPoint end(PlacedPiece at) const { return at.is_turned ? pieces_[at.piece].start : pieces_[at.piece].end; }
  PlacedPiece turned(PlacedPiece at) const {
    return {at.piece, pieces_[at.piece].may_be_turned ? !at.is_turned : at.is_turned};
  }
  // The end of the piece before position i, and the start of the one at position i.
  DrawnPoint before(std::size_t i) const { return i == 0 ? first_ : end(order_[i - 1]); }
  // The way from a place to the piece at position i, or to the end.
  double way_on(DrawnPoint from, std::size_t i) const {
    if (i < size()) return distance_nm(from, start(order_[i]));
    return last_ ? distance_nm(from, *last_) : 0;
  }
  bool has_step() { return steps_left_ > 0 && steps_left_-- > 0; }

  void measure();
  bool reverse_parts();
  bool move_pieces();
  bool move_piece(std::size_t first, std::size_t count);

  const std::vector<RoutePiece>& pieces_;
  DrawnPoint first_;
  std::optional<DrawnPoint> last_;
  std::uint64_t steps_left_;
  std::vector<PlacedPiece> order_;
  std::vector<double> forwards_;   // the ways between the pieces up to each position
  std::vector<double> backwards_;  // the same if the order is reversed
};

void PieceOrderer::measure() {
  forwards_.assign(size(), 0);
  backwards_.assign(size(), 0);
  for (std::size_t i = 1; i < size(); ++i) {
    forwards_[i] = forwards_[i - 1] + distance_nm(end(order_[i - 1]), start(order_[i]));
    backwards_[i] = backwards_[i - 1] + distance_nm(end(turned(order_[i])), start(turned(order_[i - 1])));
  }
}

// Returns whether the order became shorter.
bool PieceOrderer::reverse_parts() {
  bool is_shorter = false;
  measure();
  for (std::size_t i = 0; i < size(); ++i) {
    for (std::size_t k = i; k < size(); ++k) {
      if (!has_step()) return is_shorter;
      const double now =
          distance_nm(before(i), start(order_[i])) + forwards_[k] - forwards_[i] + way_on(end(order_[k]), k + 1);
      const double then = distance_nm(before(i), start(turned(order_[k]))) + backwards_[k] - backwards_[i] +
                          way_on(end(turned(order_[i])), k + 1);
      if (then > now - least_piece_gain) continue;
      const auto from = order_.begin() + static_cast<std::ptrdiff_t>(i);
      const auto to = order_.begin() + static_cast<std::ptrdiff_t>(k + 1);
      std::reverse(from, to);
      std::transform(from, to, from, [this](PlacedPiece at) { return turned(at); });
      measure();
      is_shorter = true;
    }
  }
  return is_shorter;
}

bool PieceOrderer::move_piece(std::size_t first, std::size_t count) {
  const std::size_t last = first + count - 1;
  const double gain = distance_nm(before(first), start(order_[first])) + way_on(end(order_[last]), last + 1) -
                      way_on(before(first), last + 1);
  if (gain < least_piece_gain) return false;
  for (std::size_t to = 0; to <= size(); ++to) {
    if (to >= first && to <= last + 1) continue;
    if (!has_step()) return false;
    const DrawnPoint from = before(to);
    const double between = way_on(from, to);
    const bool may_turn = count == 1 && pieces_[order_[first].piece].may_be_turned;
    for (const bool turns : {false, true}) {
      if (turns && !may_turn) continue;
      const PlacedPiece a = turns ? turned(order_[first]) : order_[first];
      const PlacedPiece b = turns ? a : order_[last];
      if (distance_nm(from, start(a)) + way_on(end(b), to) - between > gain - least_piece_gain) continue;
      order_[first] = a;
      const auto begin = order_.begin();
      const auto place = [](std::size_t i) { return static_cast<std::ptrdiff_t>(i); };
      if (to < first) {
        std::rotate(begin + place(to), begin + place(first), begin + place(last + 1));
      } else {
        std::rotate(begin + place(first), begin + place(last + 1), begin + place(to));
      }
      return true;
    }
  }
  return false;
}

bool PieceOrderer::move_pieces() {
  constexpr std::size_t most_moved = 3;
  bool is_shorter = false;
  for (std::size_t i = 0; i < size(); ++i) {
    for (std::size_t count = 1; count <= most_moved && i + count <= size(); ++count) {
      is_shorter = move_piece(i, count) || is_shorter;
    }
  }
  return is_shorter;
}

}  // namespace

std::vector<PlacedPiece> shorten_piece_order(const std::vector<RoutePiece>& pieces, DrawnPoint start,
                                             std::optional<DrawnPoint> end, std::uint64_t steps) {
  return PieceOrderer(pieces, start, end, steps).order();
}

}  // namespace passo
