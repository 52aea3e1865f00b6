#include "passo/trajectory/planner.hpp"

#include <algorithm>
#include <deque>
#include <optional>
#include <utility>

#include "cell.hpp"
#include "cell_queue.hpp"
#include "jerk_planner.hpp"
#include "speed_profile.hpp"
#include "speed_window.hpp"

namespace passo {
namespace {

// Where the directions of two segments differ by more, the path has a corner, and only rest takes it round.
constexpr double tangent_tolerance = 1e-6;

std::size_t limited_axes(const MotionLimits& limits) {
  return static_cast<std::size_t>(std::count_if(limits.acceleration.values.begin(), limits.acceleration.values.end(),
                                                [](MmPerSecond2 limit) { return limit > MmPerSecond2(0); }));
}

bool has_jerk_limit(const MotionLimits& limits) {
  return std::any_of(limits.jerk.values.begin(), limits.jerk.values.end(),
                     [](MmPerSecond3 limit) { return limit > MmPerSecond3(0); });
}

}  // namespace

bool has_corner(const Curve& before, const Curve& after) {
  const Point change = after.tangent(Mm(0)) - before.tangent(before.length());
  return std::any_of(change.values.begin(), change.values.end(),
                     [](double part) { return std::abs(part) > tangent_tolerance; });
}

class Planner::Implementation {
 public:
  Implementation(Source<PathItem>& path, const MotionLimits& limits, std::size_t most_queued)
      : path_(path),
        limits_(limits),
        cutter_(limits_),
        cells_(std::max<std::size_t>(most_queued, 2), limited_axes(limits)) {
    if (has_jerk_limit(limits)) jerk_limited_.emplace(path, limits, most_queued);
  }

  bool next(MotionItem& item) {
    if (jerk_limited_) return jerk_limited_->next(item);
    while (decided_ == 0 && !(cells_.empty() && closed_)) look_ahead();
    if (!cells_.empty()) {
      give_move(item);
      return true;
    }
    if (!action_) return false;
    item = *std::exchange(action_, std::nullopt);
    closed_ = false;
    return true;
  }

 private:
  // Each pass over the queue is paid for by as many new cells as it found undecided, which makes planning amortised
  // linear.
  void look_ahead() {
    const std::size_t wanted = std::max<std::size_t>(2 * cells_.size(), first_window);
    while (!closed_ && !cells_.full() && cells_.size() < wanted) pull();
    plan_backwards();
    decide_forwards();
  }

  // One more cell, or the end of the stretch.
  void pull() {
    if (cutting_ && cutter_.next(piece_)) {
      append(piece_);
      return;
    }
    cutting_ = false;
    if (!path_.next(pulled_)) {
      closed_ = true;
    } else if (const auto* action = std::get_if<Action>(&pulled_)) {
      action_ = *action;
      closed_ = true;
    } else if (auto& segment = std::get<Segment>(pulled_); segment.curve.has_length()) {
      begin(segment);
    }
  }

  void begin(const Segment& segment) {
    at_rest_ = segments_.empty() || segments_.back().mode == PathMode::exact_stop ||
               has_corner(segments_.back().curve, segment.curve);
    segments_.push_back(segment);
    cutter_.begin(segments_.back());
    cutting_ = true;
  }

  void append(const CellCutter::Piece& piece) {
    const double cap =
        at_rest_ || cells_.empty() ? 0 : std::min(cells_.back().cell.top_squared, piece.cell.top_squared);
    at_rest_ = false;
    cells_.push(piece).entry_cap = cap;
  }

  double entry_to(std::size_t i, double exit_most) const {
    const CellQueue::Entry& entry = cells_[i];
    const Cell& cell = entry.cell;
    if (cell.straight) return std::min(entry.entry_cap, exit_most + 2 * cell.acceleration * cell.length);
    return largest_entry(cells_.demands(i), entry.entry_cap, std::min(exit_most, cell.top_squared));
  }
  double exit_from(std::size_t i, double entry, double exit_most) const {
    const Cell& cell = cells_[i].cell;
    const double most = std::min(exit_most, cell.top_squared);
    if (cell.straight) return std::min(most, entry + 2 * cell.acceleration * cell.length);
    return largest_exit(cells_.demands(i), entry, most);
  }

  // What is behind the queue lies between a stop at once and nothing that slows it. Both are carried back; from where
  // a cap makes them equal they stay equal, and whatever comes later changes nothing before.
  void plan_backwards() {
    double if_rest = 0;
    double if_open = closed_ || cells_.empty() ? 0 : cells_.back().cell.top_squared;
    for (std::size_t i = cells_.size(); i-- > 0;) {
      const bool equal = if_rest == if_open;
      if_rest = cells_[i].entry_if_rest = entry_to(i, if_rest);
      if_open = cells_[i].entry_if_open = equal ? if_rest : entry_to(i, if_open);
    }
  }

  // A cell's exit is decided where both agree, or where accelerating as it may does not even reach the lower one.
  void decide_forwards() {
    double entry = speed_squared_;
    for (decided_ = 0; decided_ < cells_.size(); ++decided_) {
      const bool last = decided_ + 1 == cells_.size();
      const double if_rest = last ? 0 : cells_[decided_ + 1].entry_if_rest;
      const double if_open =
          last ? (closed_ ? 0 : cells_[decided_].cell.top_squared) : cells_[decided_ + 1].entry_if_open;
      const double exit = exit_from(decided_, entry, if_rest);
      if (if_rest != if_open && exit != exit_from(decided_, entry, if_open)) break;
      entry = exit;
    }
    // A queue that is full and holds hardly more than the braking distance is played to its middle as if the path came
    // to rest at its end: slower, and safe, and still linear.
    if (cells_.full()) decided_ = std::max(decided_, cells_.size() / 2);
  }

  void give_move(MotionItem& item) {
    auto* move = std::get_if<PlannedMove>(&item);
    if (move == nullptr) move = &item.emplace<PlannedMove>();
    const Segment& segment = segments_.front();
    move->segment = segment;
    move->phase_count = 0;
    const double length = segment.curve.length().value();
    bool ended = false;
    while (decided_ > 0 && !ended && move->phase_count + most_phases_a_cell <= PlannedMove::most_phases) {
      ended = give_cell(*move, length);
    }
    if (ended) segments_.pop_front();
  }

  // Whether the cell ends its segment.
  bool give_cell(PlannedMove& move, double segment_length) {
    const Cell& cell = cells_[0].cell;
    const double exit = exit_from(0, speed_squared_, cells_.size() > 1 ? cells_[1].entry_if_rest : 0);
    if (cell.straight) {
      add_phases({.start = cell.start,
                  .length = cell.length,
                  .acceleration = cell.acceleration,
                  .top_squared = cell.top_squared,
                  .entry_squared = speed_squared_,
                  .exit_squared = exit},
                 move);
    } else {
      add_phase(cell.start, cell.length, speed_squared_, exit, move);
    }
    const bool ended = cell.start + cell.length >= segment_length;
    move.to = Mm(ended ? segment_length : cell.start + cell.length);
    speed_squared_ = exit;
    cells_.pop();
    --decided_;
    return ended;
  }

  static constexpr std::size_t first_window = 64;

  Source<PathItem>& path_;
  const MotionLimits limits_;
  CellCutter cutter_;

  std::deque<Segment> segments_;  // whose cells are in the queue, or are being cut
  CellQueue cells_;
  bool cutting_ = false;
  bool at_rest_ = true;       // the next cell begins at rest
  std::size_t decided_ = 0;   // cells at the head whose exit speed nothing to come can change
  double speed_squared_ = 0;  // at the head's start
  bool closed_ = false;       // an action or the program's end follows the queue: it ends at rest
  std::optional<Action> action_;
  PathItem pulled_;
  CellCutter::Piece piece_;
  std::optional<JerkPlanner> jerk_limited_;  // takes over where an axis has a limit of jerk
};

Planner::Planner(Source<PathItem>& path, const MotionLimits& limits, std::size_t most_queued)
    : implementation_(std::make_unique<Implementation>(path, limits, most_queued)) {}
Planner::~Planner() = default;

bool Planner::next(MotionItem& item) {
  return implementation_->next(item);
}

}  // namespace passo
