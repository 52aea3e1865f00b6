#include "jerk_window.hpp"

#include <algorithm>
#include <cmath>

#include "speed_change.hpp"

namespace passo {
namespace {

// In cells. Each window is planned to rest at its end, and the braking for that rest is planned again in the next one.
// With 300 cells a relief takes 41 % more instructions and 0.001 % more time; with 9,600 cells it takes 2 % fewer and
// the same time, but the first move comes four times as late (smoothed_raster of motion_benchmark).
constexpr std::size_t first_jerk_window = 2400;
// Braking takes up to about 128 cells (cells_a_braking, jerk_cell.cpp). A shorter queue would hold little else.
constexpr std::size_t fewest_queued = 400;
constexpr std::size_t phases_a_cell = 2;
// Cells needed to plan a start in motion. The acceleration can rise three times in them (cells_a_ramp, jerk_cell.cpp).
constexpr std::size_t fewest_in_motion = 32;

}  // namespace

JerkWindow::JerkWindow(const Inputs& inputs, const PlanEffort& effort)
    : path_(inputs.path),
      feeds_(inputs.feeds),
      stops_(inputs.stops),
      cutter_(inputs.axes),
      profile_(inputs.axes, effort),
      most_queued_(std::max(inputs.most_queued, fewest_queued)),
      shapes_(inputs.axes.size()) {}

void JerkWindow::begin_at(const PathState& start, const Point& stopped) {
  profile_.drop(profile_.size());
  if (start.speed > 0) profile_.begin_in_motion({.speed = start.speed, .acceleration = start.acceleration});
  start_ = start;
  at_stops_.stopped = stopped;
  at_stops_.after_corner = false;
  cut_ = start.segment;
  started_ = cutting_ = closed_ = false;
  length_ = 0;
  way_to_rest_ = std::numeric_limits<double>::infinity();
  given_ = decided_ = 0;
}

// Begins where the window before has ended: at a stop between two segments.
void JerkWindow::begin_after_stop() {
  begin_at({.segment = path_.first()});
  at_stops_.after_corner = true;
}

// The greatest speed (squared) at the start. Nothing is read from the path before it is needed.
double JerkWindow::start_squared(const Segment& first) const {
  if (start_.speed > 0) return start_.speed * start_.speed;
  if (stops_ == nullptr) return 0;
  const Point direction = first.curve.tangent(Mm(start_.s));
  return at_stops_.after_corner ? stops_->between(at_stops_.end_direction, direction).start
                                : stops_->at_start(direction, at_stops_.stopped);
}

// The greatest speed (squared) at the stop after that segment. A path that waits for its next line may go on there.
double JerkWindow::end_squared_after(std::uint64_t number, const Point& direction) const {
  if (stops_ == nullptr) return 0;
  if (const Segment* const after = path_.at(number + 1)) {
    return stops_->between(direction, after->curve.tangent(Mm(0))).end;
  }
  const Action* const action = path_.action();
  return action != nullptr && action->kind == Action::Kind::await_line ? 0 : stops_->at_end(direction);
}

bool JerkWindow::can_go_on(double way) {
  while (!closed_ && profile_.size() < most_queued_ && (length_ < way || profile_.size() < fewest_in_motion)) pull();
  if (profile_.size() == 0) return false;
  decided_ = profile_.plan(closed_, at_stops_.end_squared);
  return !profile_.fell_back();
}

bool JerkWindow::can_rest_after(double way) {
  way_to_rest_ = way;
  while (!closed_ && profile_.size() < most_queued_) pull();
  if (!closed_ || profile_.size() == 0) return false;
  decided_ = profile_.plan(closed_, at_stops_.end_squared);
  return !profile_.fell_back();
}

bool JerkWindow::next(PlannedMove& move) {
  for (;; begin_after_stop()) {
    if (goes_from_rest_to_rest(move)) return true;
    while (given_ == decided_ && !(profile_.size() == given_ && closed_)) look_ahead();
    if (given_ < decided_) break;
    if (path_.front() == nullptr) return false;
  }
  move.begin_on(*path_.front());
  bool ended = false;
  while (given_ < decided_ && !ended && move.phase_count + phases_a_cell <= PlannedMove::most_phases) {
    ended = add_cell(given_, move);
    ++given_;
  }
  return true;
}

// Adds a cell's phases. Returns whether the segment ends there.
bool JerkWindow::add_cell(std::size_t i, PlannedMove& move) const {
  profile_.add_phases(i, move);
  const JerkCell& cell = profile_.cell(i);
  move.to = Mm(cell.ends_segment ? move.segment.curve.length().value() : cell.start + cell.length);
  return cell.ends_segment;
}

bool JerkWindow::peek(std::size_t ahead, std::uint64_t segment, PlannedMove& move) const {
  const std::size_t i = given_ + ahead;
  if (i >= profile_.planned()) return false;
  move.begin_on(*path_.at(segment));
  add_cell(i, move);
  return true;
}

void JerkWindow::look_ahead() {
  profile_.drop(given_);
  given_ = decided_ = 0;
  const std::size_t wanted =
      std::max<std::size_t>(profile_.fell_back() ? profile_.size() : 2 * profile_.size(), first_jerk_window);
  while (!closed_ && profile_.size() < wanted && profile_.size() < most_queued_) pull();
  if (profile_.size() == 0) return;
  decided_ = profile_.plan(closed_, at_stops_.end_squared);
  if (!closed_ && profile_.size() >= most_queued_) decided_ = std::max(decided_, profile_.planned() / 2);
}

// Gives the whole stretch if it is one straight segment, from rest to rest.
bool JerkWindow::goes_from_rest_to_rest(PlannedMove& move) {
  if (started_ || start_.speed > 0) return false;
  const Segment* segment = path_.at(start_.segment);
  if (segment == nullptr || segment->curve.shape() != Curve::Shape::line) return false;
  if (path_.after(start_.segment) != nullptr) return false;
  cutter_.begin(*segment, {.from = start_.s, .feed = feeds_.speed_on(*segment)});
  if (!cutter_.is_straight()) return false;
  move.begin_on(*segment);
  const double start = start_squared(*segment);  // first: it needs the direction in which the window before ended
  at_stops_.end_direction = segment->curve.tangent(segment->curve.length());
  const double end = end_squared_after(start_.segment, at_stops_.end_direction);
  add_rest_to_rest(
      {.from = start_.s, .to = segment->curve.length().value(), .entry = std::sqrt(start), .exit = std::sqrt(end)},
      cutter_.path_limits(), move);
  cut_ = start_.segment + 1;
  started_ = closed_ = true;
  return true;
}

// Pulls one more cell. A segment is cut only when the next segment is known.
void JerkWindow::pull() {
  if (cutting_ && cutter_.next(cell_, shapes_.data())) {
    profile_.push(cell_, shapes_.data());
    estimate_ =
        std::min(std::min(estimate_, profile_.last_cap()) + 2 * cell_.acceleration * cell_.length, cell_.top_squared);
    length_ += cell_.length;
    return;
  }
  if (cutting_) ++cut_;
  cutting_ = false;
  const bool rested = way_to_rest_ <= length_;
  const Segment* segment = rested ? nullptr : started_ ? path_.after(cut_ - 1) : path_.at(cut_);
  closed_ = segment == nullptr;
  if (closed_) return;
  const double from = started_ ? 0 : start_.s;
  const double length = segment->curve.length().value();
  // A rest near the segment's end is moved there.
  const double rest = from + way_to_rest_ - length_;
  const double least = least_rest(segment->curve, start_.speed);
  const bool rests = rest < length + least;
  const double to = rest < length - least ? rest : length;
  if (rests) way_to_rest_ = length_;
  const Segment* after = rests ? nullptr : path_.after(cut_);
  if (!started_) {
    estimate_ = start_squared(*segment);
    if (start_.speed == 0) profile_.begin_at_stop(estimate_);
  } else {
    const Segment& before = *path_.at(cut_ - 1);
    estimate_ = std::min(estimate_, cutter_.joint_cap(before, *segment));
  }
  at_stops_.end_squared = 0;
  if (after == nullptr && !rests) {
    at_stops_.end_direction = segment->curve.tangent(segment->curve.length());
    at_stops_.end_squared = end_squared_after(cut_, at_stops_.end_direction);
  }
  if (rests && stops_ != nullptr) {
    at_stops_.end_squared = stops_->at_end(segment->curve.tangent(Mm(to)));
  }
  const double exit = after == nullptr ? at_stops_.end_squared : cutter_.joint_cap(*segment, *after);
  cutter_.begin(
      *segment,
      {.from = from, .to = to, .entry_squared = estimate_, .exit_squared = exit, .feed = feeds_.speed_on(*segment)});
  started_ = cutting_ = true;
}

}  // namespace passo
