// AccelerationLaw: the cells ahead in a queue, and the speeds at their ends by two passes (planner.hpp).
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "arithmetic.hpp"
#include "cell.hpp"
#include "cell_queue.hpp"
#include "rest.hpp"
#include "shorten.hpp"
#include "speed_law.hpp"
#include "speed_profile.hpp"
#include "speed_window.hpp"

namespace passo {
namespace {

// A cell in which the square of the speed can change by less than this share of itself is short enough: in two halves
// it would gain a quarter of the share at most.
constexpr double least_change = 0.04;
// Of what a stop leaves of a cell, which is a micrometre. A shorter rest of a cell is rounding: places of up to ten
// metres are 1e-12 apart, and no machine steps so finely.
constexpr double rounding_of_rest = 1e-3;
// In cells. Any size from 32 to 256 costs the same instructions within 0.1 % on chords; it doubles where that is too
// short for braking. A smaller window lets the first move come sooner.
constexpr std::size_t first_window = 64;

class AccelerationLaw final : public SpeedLaw {
 public:
  explicit AccelerationLaw(const LawInputs& inputs)
      : path_(inputs.path),
        wishes_(inputs.wishes),
        cutter_(inputs.limits),
        rests_(inputs.limits),
        cells_(std::max<std::size_t>(inputs.most_queued, 2), cutter_.most_demands(), cutter_.most_falling()) {}

  void begin() override {
    cells_.clear();
    next_segment_ = path_.first();
    cutting_ = closed_ = braking_ = false;
    decided_ = 0;
    speed_squared_ = 0;
    stands_ = true;
  }

  void feeds_changed() override {
    std::uint64_t number = path_.first();
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const Segment& segment = *path_.at(number);
      set_caps(i, feed_squared(segment));
      if (!(cells_[i].cell.end < segment.curve.length().value())) ++number;
    }
    if (cutting_) cut_feed_squared_ = feed_squared(*path_.at(next_segment_ - 1));
    decided_ = 0;
  }

  void path_grew() override {
    closed_ = false;
    decided_ = 0;
  }

  bool go_on(PlannedMove& move) override {
    if (std::exchange(braking_, false)) decided_ = 0;
    while (decided_ == 0 && !(cells_.empty() && closed_)) look_ahead();
    if (cells_.empty()) return false;
    if (std::exchange(stands_, false) && rests_.any()) speed_squared_ = cells_[0].decided_entry;
    emit_move(move);
    return true;
  }

  // From rest on it gives nothing; so where no path is left.
  bool brake(PlannedMove& move) override {
    braking_ = true;
    const Segment* segment = path_.front();
    if (speed_squared_ == 0 || segment == nullptr || stops_at_once(*segment)) return false;
    move.begin_on(*segment);
    bool complete = false;
    while (speed_squared_ > 0 && !complete && move.phase_count < PlannedMove::most_phases) {
      const Ride ride = shortest_stop(*segment);
      add_phase(cells_[0].cell.start, ride.way, speed_squared_, ride.exit, move);
      complete = go(ride, move);
      if (!stands_ && move.to < segment->curve.length() && stops_at_once(*segment)) {
        move.stops_at_once = true;
        return true;
      }
    }
    if (speed_squared_ == 0 && !stands_) stand_after({});
    return true;
  }

  void braking_plan(Planner::Braking /*how*/, std::vector<PlannedMove>& plan) override {
    double speed_squared = speed_squared_;
    std::uint64_t segment = path_.first();
    for (std::size_t i = 0; speed_squared > 0 && i < cells_.size() && !(i > 0 && cells_[i].begins_at_rest()); ++i) {
      if (!plan.empty() && plan.back().to >= plan.back().segment.curve.length()) ++segment;
      const Ride ride = shortest_ride(i, speed_squared);
      add_ride(*path_.at(segment), cells_[i].cell, speed_squared, ride, plan);
      speed_squared = ride.exit;
    }
  }

 private:
  // A bent cell either speeds up or brakes. From one slow place to the next it takes more than one; from rest to rest,
  // as in what a hold has left of a corner, a single cell would take for ever.
  bool is_front_too_long() const {
    const Cell& cell = cells_[0].cell;
    if (cell.straight || cell.length < rounding_of_rest * cell.smallest_rest) return false;
    const double exit = exit_of_front();
    if (2 * cell.acceleration * cell.length < least_change * (speed_squared_ + exit)) return false;
    return is_too_long(cells_.demands(0), cells_.falling(0),
                       {.length = cell.length, .entry = speed_squared_, .exit = exit, .top = cells_[0].top_squared});
  }
  // A pass over the queue comes only after as many new cells as the queue held. So planning takes amortised linear
  // time.
  void look_ahead() {
    const std::size_t wanted = std::max<std::size_t>(2 * cells_.size(), first_window);
    while (!closed_ && !cells_.full() && cells_.size() < wanted) pull();
    plan_backwards();
    decide_forwards();
  }

  // Pulls one more cell, or the end of the stretch.
  void pull() {
    if (cutting_) {
      append();
      return;
    }
    const Segment* segment = path_.at(next_segment_);
    closed_ = segment == nullptr;
    if (closed_) {
      if (!cells_.empty()) end_cap_ = rests_.at_end(end_direction(next_segment_ - 1));
      return;
    }
    const bool is_first = next_segment_ == path_.first();
    at_rest_ = is_first || rests_between(*path_.at(next_segment_ - 1), *segment);
    if (at_rest_) {
      if (rests_.any()) rest_ = rest_before(*segment, is_first);
      reached_squared_ = rest_.start;
    }
    cutter_.begin(*segment, reached_squared_);
    cutting_ = true;
    cut_feed_squared_ = feed_squared(*segment);
    ++next_segment_;
  }

  // The limits at the start of the next segment, where the path rests.
  StopSpeeds::Pair rest_before(const Segment& segment, bool is_first) {
    const Point direction = segment.curve.tangent(Mm(0));
    if (is_first) return {.start = rests_.at_start(direction, stopped_)};
    return rests_.between(end_direction(next_segment_ - 1), direction);
  }
  Point end_direction(std::uint64_t number) {
    const Curve& curve = path_.at(number)->curve;
    return curve.tangent(curve.length());
  }

  void append() {
    cutter_.next(cells_.push());
    cutting_ = !cutter_.at_end();
    if (std::exchange(at_rest_, false)) cells_.back().rest_at(rest_.end, rest_.start);
    const Cell& cell = cells_.back().cell;
    reached_squared_ = std::min(cell.top_squared, reached_squared_ + 2 * cell.acceleration * cell.length);
    set_caps(cells_.size() - 1, cut_feed_squared_);
  }

  double feed_squared(const Segment& segment) const { return squared(wishes_.feeds.speed_on(segment)); }

  void set_caps(std::size_t i, double feed_squared) {
    CellQueue::Entry& entry = cells_[i];
    entry.top_squared = std::min(entry.cell.top_squared, feed_squared);
    entry.entry_cap = std::min(entry.rest_cap, entry.top_squared);
    if (i > 0 && !entry.begins_at_rest()) entry.entry_cap = std::min(entry.entry_cap, cells_[i - 1].top_squared);
  }

  double entry_to(std::size_t i, double exit_most) {
    const CellQueue::Entry& entry = cells_[i];
    const Cell& cell = entry.cell;
    if (cell.straight) return std::min(entry.entry_cap, exit_most + 2 * cell.acceleration * cell.length);
    const double most = std::min(exit_most, entry.top_squared);
    if (entry.cell.falling_count == 0) return largest_entry(cells_.demands(i), entry.entry_cap, most);
    return largest_entry(cells_.demands(i), cells_.falling(i), entry.entry_cap, most);
  }
  // The fastest exit. If the entry is too fast for it (the override was lowered), the slowest possible exit.
  double exit_from(std::size_t i, double entry, double exit_most) const {
    if (exit_most == 0) return 0;  // whatever came before left room for it
    const CellQueue::Entry& queued = cells_[i];
    const double most = std::min(exit_most, queued.top_squared);
    if (queued.cell.falling_count > 0) {
      return largest_exit(cells_.demands(i), cells_.falling(i), entry, most, queued.top_squared);
    }
    if (!queued.cell.straight) return largest_exit(cells_.demands(i), entry, most);
    const double change = 2 * queued.cell.acceleration * queued.cell.length;
    const bool too_fast = entry - change > most + rounding * entry;
    return too_fast ? entry - change : std::min(most, entry + change);
  }

  // The path after the queue lies between two cases: a stop at once, and nothing that slows. Both are carried back.
  // Where a cap makes them equal they stay equal, and later cells change nothing before that place.
  void plan_backwards() {
    double if_rest = exit_if_rest();
    double if_open = closed_ || cells_.empty() ? if_rest : cells_.back().top_squared;
    for (std::size_t i = cells_.size(); i-- > 0;) {
      const bool equal = if_rest == if_open;
      if (!equal) if_open = entry_to(i, if_open);
      if_rest = cells_[i].entry_if_rest = entry_to(i, if_rest);  // after if_open: its choice of lines is the one kept
      if (equal) if_open = if_rest;
      cells_[i].entry_if_open = if_open;
      if (rests_.any() && i > 0 && cells_[i].begins_at_rest()) if_rest = if_open = exit_before(i);
    }
  }

  // A cell's exit is decided where both cases agree, or where accelerating does not even reach the lower one.
  void decide_forwards() {
    // A full queue may hold hardly more than the braking distance. Its first half is then played as if the path came to
    // rest at its end: slower, but safe and still linear.
    const std::size_t at_least = cells_.full() ? cells_.size() / 2 : 0;
    const bool jumps = rests_.any();
    double entry = speed_squared_;
    for (decided_ = 0; decided_ < cells_.size(); ++decided_) {
      if (jumps && !begins(decided_, decided_ < at_least, entry)) break;
      const bool last = decided_ + 1 == cells_.size();
      double if_rest = last ? exit_if_rest() : cells_[decided_ + 1].entry_if_rest;
      double if_open = last ? (closed_ ? if_rest : cells_[decided_].top_squared) : cells_[decided_ + 1].entry_if_open;
      if (jumps && !last && cells_[decided_ + 1].begins_at_rest()) if_rest = if_open = exit_before(decided_ + 1);
      const double exit = exit_from(decided_, entry, if_rest);
      if (decided_ >= at_least && if_rest != if_open && exit != exit_from(decided_, entry, if_open)) break;
      cells_[decided_].decided_entry = std::exchange(entry, exit);
      cells_[decided_].decided_exit = exit;
    }
  }

  // From rest a cell may be entered with some speed of its own. False: a later cell could still change this speed, and
  // `at_once` is false.
  bool begins(std::size_t i, bool at_once, double& entry) {
    if (i > 0 ? !cells_[i].begins_at_rest() : !stands_) return true;
    const double most = i > 0 ? CellQueue::no_rest : cap_from_rest();
    entry = std::min(most, cells_[i].entry_if_rest);
    return at_once || entry == std::min(most, cells_[i].entry_if_open);
  }
  // The limit at the end of the cell before cell i, which begins at rest.
  double exit_before(std::size_t i) const { return std::min(cells_[i].rest_exit, cells_[i - 1].top_squared); }
  // The square of the speed at the end of the queue if the path comes to rest there.
  double exit_if_rest() const {
    return closed_ && !cells_.empty() ? std::min(end_cap_, cells_[cells_.size() - 1].top_squared) : 0;
  }

  // The limit of the speed with which the motion may begin at its present place.
  double cap_from_rest() { return rests_.at_start(path_.front()->curve.tangent(Mm(cells_[0].cell.start)), stopped_); }

  // The machine has come to rest, and stopped with this velocity.
  void stand_after(const Point& velocity) {
    speed_squared_ = 0;
    stopped_ = velocity;
    stands_ = true;
  }

  void emit_move(PlannedMove& move) {
    move.begin_on(*path_.front());
    bool complete = false;
    while (decided_ > 0 && !complete && move.phase_count + most_phases_a_cell <= PlannedMove::most_phases) {
      while (is_front_too_long()) halve_front();
      const Cell& cell = cells_[0].cell;
      const double exit = exit_of_front();
      // The feed was lowered: slow down at once, not only at the cell's end.
      const double too_fast = speed_squared_ - cells_[0].top_squared;
      const double slowing = cell.straight ? too_fast / (2 * cell.acceleration) : 0;
      if (too_fast > rounding * speed_squared_ && slowing > cell.smallest_rest &&
          slowing + cell.smallest_rest < cell.length) {
        add_phase(cell.start, slowing, speed_squared_, cells_[0].top_squared, move);
        complete = go({slowing, cells_[0].top_squared}, move);
        continue;
      }
      if (cell.straight) {
        add_phases({.start = cell.start,
                    .length = cell.length,
                    .acceleration = cell.acceleration,
                    .top_squared = std::max({cells_[0].top_squared, speed_squared_, exit}),
                    .entry_squared = speed_squared_,
                    .exit_squared = exit},
                   move);
      } else {
        add_phase(cell.start, cell.length, speed_squared_, exit, move);
      }
      complete = go({cell.length, exit}, move);
    }
  }

  double exit_of_front() const {
    const bool as_decided = decided_ > 0 && cells_[0].decided_entry == speed_squared_;
    return as_decided ? cells_[0].decided_exit : planned_exit(0, speed_squared_);
  }
  // The exit of cell i, entered with this speed.
  double planned_exit(std::size_t i, double entry) const {
    if (i + 1 == cells_.size()) return exit_from(i, entry, exit_if_rest());
    const CellQueue::Entry& next = cells_[i + 1];
    return exit_from(i, entry, rests_.any() && next.begins_at_rest() ? exit_before(i + 1) : next.entry_if_rest);
  }

  // To rest within cell i if possible, else through it as slowly as possible. Never faster than without the hold: where
  // the path rests anyway, rounding leaves no speed. And where a narrow bend leaves one speed only, a hair more of it,
  // as the rest of a cell may ask for, is soon too much for any braking.
  Ride shortest_ride(std::size_t i, double entry) const {
    const Ride ride = hardest_braking(cells_[i].cell, cells_.demands(i), cells_.falling(i), entry);
    if (!(ride.exit > 0)) return ride;
    // The rest of a cell allows more than the whole did, so the motion may be ahead of what was decided.
    const bool is_ahead = i >= decided_ || entry > cells_[i].decided_entry * (1 + rounding);
    const double decided = is_ahead ? ride.exit : cells_[i].decided_exit;
    return {ride.way, std::min({ride.exit, planned_exit(i, entry), decided})};
  }

  // Whether the motors stop at once from the present velocities: then they have stopped.
  bool stops_at_once(const Segment& segment) {
    if (!rests_.any() || cells_.empty()) return false;
    const Point direction = segment.curve.tangent(Mm(cells_[0].cell.start));
    if (speed_squared_ > rests_.at_end(direction) * (1 + rounding)) return false;
    stand_after(direction * std::sqrt(speed_squared_));
    return true;
  }

  // The shortest ride through the first cell, or to the place on a line where the motors may stop at once. A bend is
  // passed in short cells.
  Ride shortest_stop(const Segment& segment) const {
    const Ride ride = shortest_ride(0, speed_squared_);
    const Cell& cell = cells_[0].cell;
    if (!rests_.any() || segment.curve.shape() != Curve::Shape::line) return ride;
    const double least = rests_.at_end(segment.curve.tangent(Mm(cell.start)));
    const double way = ride.way * (speed_squared_ - least) / (speed_squared_ - ride.exit);
    return ride.exit < least && way + cell.smallest_rest < cell.length ? Ride{way, least} : ride;
  }

  // Removes the move's way from the queue. Returns whether the move is complete: at the end of its segment or time.
  bool go(const Ride& ride, PlannedMove& move) {
    const Segment& segment = move.segment;
    const Cell& cell = cells_[0].cell;
    const double cell_end = cell.end;
    const double least_rest = rounding_of_rest * cell.smallest_rest;
    move.to = Mm(ride.way < cell.length ? cell.start + ride.way : cell_end);
    speed_squared_ = ride.exit;
    const std::optional<PlannedMove> rest = shorten(move, wishes_.longest_move, Mm(least_rest));
    if (rest) speed_squared_ = squared(rest->begin()->velocity.value());
    if (move.to.value() < cell_end - least_rest) {
      // The exit of the rest of the cell is decided as it was for the whole.
      cut_front_again(segment, move.to.value(), cell_end, ride.exit);
      return true;
    }
    decided_ -= std::min<std::size_t>(decided_, 1);
    move.to = Mm(cell_end);
    cells_.pop();
    if (rests_.any() && (cells_.empty() || cells_[0].begins_at_rest())) {
      stand_after(segment.curve.tangent(segment.curve.length()) * std::sqrt(speed_squared_));
    }
    return rest || cell_end >= segment.curve.length().value();
  }

  // Cuts the first cell again from the present place of the path. Its exit stays.
  void cut_front_again(const Segment& segment, double from, double to, double exit) {
    const CellPlace front = cells_.front_again();
    cutter_.cut(segment, from, to, front.cell.straight, front);
    front.allow(speed_squared_, exit);
    if (!rests_.any()) return;
    cells_[0].go_on_at_entry();
    set_caps(0, feed_squared(segment));
  }

  // The exit stays, and with it all that was decided.
  void halve_front() {
    const double start = cells_[0].cell.start;
    const double end = cells_[0].cell.end;
    const double middle = start + cells_[0].cell.length / 2;
    const double exit = exit_of_front();
    const double halfway = (speed_squared_ + exit) / 2;
    const CellPlace second = cells_.front_again();
    cutter_.cut(*path_.front(), middle, end, false, second);
    second.allow(halfway, exit);
    const CellPlace first = cells_.push_front();
    cutter_.cut(*path_.front(), start, middle, false, first);
    first.allow(speed_squared_, halfway);
    cells_[1].go_on_at_entry();
    for (std::size_t i = 0; i < 2; ++i) set_caps(i, feed_squared(*path_.front()));
    cells_[1].entry_if_rest = std::max(halfway, entry_to(1, exit));
    if (decided_ == 0) return;
    ++decided_;
    for (std::size_t i = 0; i < 2; ++i) {
      CellQueue::Entry& half = cells_[i];
      half.decided_entry = i == 0 ? speed_squared_ : cells_[0].decided_exit;
      half.decided_exit = exit_from(i, half.decided_entry, i == 0 ? cells_[1].entry_if_rest : exit);
    }
  }

  PathAhead& path_;
  const MidRunWishes& wishes_;
  CellCutter cutter_;
  StopSpeeds rests_;

  CellQueue cells_;
  std::uint64_t next_segment_ = 0;  // the first segment of which no cell is cut
  bool cutting_ = false;
  bool at_rest_ = true;          // the next cell begins at rest
  StopSpeeds::Pair rest_;        // then: the limits there
  double cut_feed_squared_ = 0;  // of the segment that is being cut
  double reached_squared_ = 0;   // the square of the highest speed at which it may begin
  std::size_t decided_ = 0;      // cells at the head whose exit speed no later cell can change
  double speed_squared_ = 0;     // at the start of the head
  bool closed_ = false;          // an action or the program's end follows the queue, which ends at rest
  double end_cap_ = 0;           // then: the limit of the square of the speed at its end
  bool braking_ = false;
  bool stands_ = true;  // at rest, which the motion may leave with some speed
  Point stopped_;       // how fast the axes were when the machine last came to rest
};

}  // namespace

std::unique_ptr<SpeedLaw> acceleration_law(const LawInputs& inputs) {
  return std::make_unique<AccelerationLaw>(inputs);
}

}  // namespace passo
