#include "passo/stock/wire_cutter.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <thread>
#include <utility>
#include <vector>

namespace passo {
namespace {

constexpr std::size_t batch_chords = 8192;
constexpr unsigned most_threads = 64;
// A chord may be this share of a cell away from its curve.
constexpr double chord_share = 0.1;
constexpr double most_chords_of_a_move = 1e6;

struct Spot2 {
  double x = 0;
  double y = 0;
};

// Both ends of the wire.
struct Ends {
  Spot2 left;
  Spot2 right;

  // `share`: of the way from the left tower to the right one.
  Spot2 at(double share) const { return {left.x + (right.x - left.x) * share, left.y + (right.y - left.y) * share}; }
};

struct WireChord {
  Ends from;
  Ends to;
  double time = 0;         // s; 0: not known
  std::uint32_t move = 0;  // of the batch
};

// What a move did in the slices of one thread.
struct SliceTally {
  std::uint64_t cells = 0;                                      // times the weight of their slice
  std::size_t first = std::numeric_limits<std::size_t>::max();  // the first cell of all that it melted
  double least_kerf = std::numeric_limits<double>::infinity();
  double most_kerf = 0;

  void take(const SliceTally& other) {
    cells += other.cells;
    first = std::min(first, other.first);
    least_kerf = std::min(least_kerf, other.least_kerf);
    most_kerf = std::max(most_kerf, other.most_kerf);
  }
};

// The range of the indices of cells whose middles lie from `low` to `high`.
struct IndexRange {
  std::size_t first = 0;
  std::size_t end = 0;
};
IndexRange cells_between(double low, double high, double origin, double cell, std::size_t count) {
  const double first = std::ceil((low - origin) / cell - 0.5);
  const double last = std::floor((high - origin) / cell - 0.5);
  const auto most = static_cast<double>(count);
  if (!(last >= 0 && first < most && first <= last)) return {};
  return {static_cast<std::size_t>(std::max(0.0, first)), static_cast<std::size_t>(std::min(most, last + 1))};
}

}  // namespace

class WireCutter::Implementation {
 public:
  Implementation(FoamBlock& foam, const WireCutterOptions& options, Watcher watcher)
      : foam_(foam), options_(options), watcher_(std::move(watcher)) {
    options_.threads = std::clamp(options_.threads, 1U, most_threads);
  }

  void cut(const Curve& curve, const Point& zero, const WireMove& move);
  void finish();

 private:
  Ends ends_of(const Point& place, const Point& zero) const;
  void cut_slice(std::size_t slice, std::vector<SliceTally>& tallies);
  void melt(const Spot2& from, const Spot2& to, double radius, std::size_t slice, SliceTally& tally);

  FoamBlock& foam_;
  WireCutterOptions options_;
  Watcher watcher_;
  std::vector<WireChord> chords_;
  std::vector<WireCut> moves_;
};

Ends WireCutter::Implementation::ends_of(const Point& place, const Point& zero) const {
  const auto at = [&](Axis axis) { return place[axis] - zero[axis]; };
  const Spot2 left{at(Axis::x), at(Axis::y)};
  return {left, options_.has_four_axes ? Spot2{at(Axis::u), at(Axis::v)} : left};
}

void WireCutter::Implementation::cut(const Curve& curve, const Point& zero, const WireMove& move) {
  const double length = curve.length().value();
  const double tolerance = chord_share * foam_.cell();
  const double wanted = std::ceil(length * std::sqrt(curve.curvature() / (8 * tolerance)));
  const double count = std::clamp(wanted, 1.0, most_chords_of_a_move);
  const auto number = static_cast<std::uint32_t>(moves_.size());
  Ends before = ends_of(curve.start(), zero);
  for (double i = 1; i <= count; ++i) {
    const Ends here = ends_of(i < count ? curve.at(Mm(length * i / count)) : curve.end(), zero);
    chords_.push_back({before, here, move.time.value() / count, number});
    before = here;
  }
  moves_.push_back({.move = move});
  if (chords_.size() >= batch_chords) finish();
}

// Cells within the band of `radius` and farthest() around the way learn how far they are from it.
void WireCutter::Implementation::melt(const Spot2& from, const Spot2& to, double radius, std::size_t slice,
                                      SliceTally& tally) {
  const double cell = foam_.cell();
  const StockBlock& block = foam_.block();
  const double band = radius + double{foam_.farthest()};
  const double way_x = to.x - from.x;
  const double way_y = to.y - from.y;
  const double square = way_x * way_x + way_y * way_y;
  const IndexRange rows =
      cells_between(std::min(from.y, to.y) - band, std::max(from.y, to.y) + band, block.low.y, cell, foam_.rows());
  for (std::size_t row = rows.first; row < rows.end; ++row) {
    const double y = foam_.y_of(row);
    // The part of the way that is within the band of this row, from and to in shares of it.
    double first = 0;
    double last = 1;
    if (std::abs(way_y) > 1e-12) {
      const auto [low, high] = std::minmax({(y - band - from.y) / way_y, (y + band - from.y) / way_y});
      first = std::clamp(low, 0.0, 1.0);
      last = std::clamp(high, 0.0, 1.0);
    }
    const auto [left, right] = std::minmax({from.x + way_x * first, from.x + way_x * last});
    const IndexRange columns = cells_between(left - band, right + band, block.low.x, cell, foam_.columns());
    float* const cells = foam_.clearance(row, slice);
    for (std::size_t column = columns.first; column < columns.end; ++column) {
      const double x = foam_.x_of(column);
      const double along =
          square > 0 ? std::clamp(((x - from.x) * way_x + (y - from.y) * way_y) / square, 0.0, 1.0) : 0.0;
      const double away_x = x - from.x - way_x * along;
      const double away_y = y - from.y - way_y * along;
      const auto clear = static_cast<float>(std::sqrt(away_x * away_x + away_y * away_y) - radius);
      if (!(clear < cells[column])) continue;
      if (cells[column] > 0 && clear <= 0) {
        tally.cells += foam_.weight(slice);
        tally.first = std::min(tally.first, (slice * foam_.rows() + row) * foam_.columns() + column);
      }
      cells[column] = clear;
    }
  }
}

void WireCutter::Implementation::cut_slice(std::size_t slice, std::vector<SliceTally>& tallies) {
  const double share = options_.has_four_axes ? foam_.z_of(slice) / options_.span : 0;
  for (const WireChord& chord : chords_) {
    const Spot2 from = chord.from.at(share);
    const Spot2 to = chord.to.at(share);
    const double way = std::hypot(to.x - from.x, to.y - from.y);
    const double speed = chord.time > 0 ? way / chord.time : std::numeric_limits<double>::infinity();
    const double kerf = options_.kerf(speed, moves_[chord.move].move.time.value());
    SliceTally& tally = tallies[chord.move];
    tally.least_kerf = std::min(tally.least_kerf, kerf);
    tally.most_kerf = std::max(tally.most_kerf, kerf);
    melt(from, to, kerf / 2, slice, tally);
  }
}

void WireCutter::Implementation::finish() {
  const std::size_t threads = std::min<std::size_t>(options_.threads, foam_.slices());
  std::vector<std::vector<SliceTally>> tallies(threads, std::vector<SliceTally>(moves_.size()));
  std::atomic<std::size_t> next = 0;
  const auto work = [&](std::vector<SliceTally>& own) {
    for (std::size_t slice = next++; slice < foam_.slices(); slice = next++) cut_slice(slice, own);
  };
  std::vector<std::thread> others;
  for (std::size_t i = 1; i < threads; ++i) others.emplace_back([&work, &own = tallies[i]] { work(own); });
  work(tallies.front());
  for (std::thread& other : others) other.join();

  for (std::size_t move = 0; move < moves_.size(); ++move) {
    SliceTally all = tallies.front()[move];
    for (std::size_t i = 1; i < threads; ++i) all.take(tallies[i][move]);
    WireCut& cut = moves_[move];
    cut.volume = static_cast<double>(all.cells) * foam_.volume_of_cell();
    cut.least_kerf = all.least_kerf;
    cut.most_kerf = all.most_kerf;
    if (all.cells > 0) {
      const std::size_t row = all.first / foam_.columns();
      cut.place = {foam_.x_of(all.first % foam_.columns()), foam_.y_of(row % foam_.rows()),
                   foam_.z_of(row / foam_.rows())};
    }
    if (watcher_) watcher_(cut);
  }
  chords_.clear();
  moves_.clear();
}

WireCutter::WireCutter(FoamBlock& foam, const WireCutterOptions& options, Watcher watcher)
    : implementation_(std::make_unique<Implementation>(foam, options, std::move(watcher))) {}

WireCutter::~WireCutter() = default;

void WireCutter::cut(const Curve& curve, const Point& zero, const WireMove& move) {
  implementation_->cut(curve, zero, move);
}

void WireCutter::finish() {
  implementation_->finish();
}

}  // namespace passo
