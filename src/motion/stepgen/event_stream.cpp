#include "event_stream.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "passo/stepgen/event_leader.hpp"

namespace passo {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::int64_t finest_grid = whole_step / event_leader::finest_division;
constexpr double turn_an_event = 0.25;  // radians
constexpr double smallest_distance = place_per_step / 256;

}  // namespace

EventStream::EventStream(const StepOptions& options)
    : motor_count_(options.kinematics.motor_count()),
      tick_rate_(options.clock.tick_rate.value()),
      shortest_interval_(std::llround(options.clock.tick_rate / options.clock.highest_event_rate * whole_tick)),
      slowest_share_(options.clock.highest_event_rate.value() * slow_share),
      screws_(options) {
  divide_below(Exactness{}.least_rate);
  std::ranges::copy(options.kinematics.rows(), motors_.begin());
  const MotorPosition start = options.kinematics.motors(options.start, options.downs);
  for (unsigned m = 0; m < motor_count_; ++m) end_[m] = (start[m] + 0.5) * place_per_step;
  here_ = at_last_event_ = end_;
}

std::int64_t EventStream::fixed_time(double seconds) const {
  const double units = (fraction_ + seconds * tick_rate_) * whole_tick;  // never negative, so the cast below rounds
  return (ticks_ << 16) + static_cast<std::int64_t>(units + 0.5) + whole_tick / 2;
}

void EventStream::advance(double seconds) {
  const double ticks = fraction_ + seconds * tick_rate_;
  const double whole = std::floor(ticks);
  ticks_ += static_cast<std::int64_t>(whole);
  fraction_ = ticks - whole;
}

void EventStream::go_back_to(std::int64_t time) {
  ticks_ = (time - whole_tick / 2) >> 16;
  fraction_ = static_cast<double>((time - whole_tick / 2) & (whole_tick - 1)) / whole_tick;
}

void EventStream::start_move(const PlannedMove& move) {
  clock_.start(move);
  in_move_ = true;
  move_end_ = move.to.value();
  screws_.start_move(move.segment);
  start_part(move.segment.curve, move.from().value());
}

void EventStream::start_part(const Curve& curve, double from) {
  path_.start(curve, screws_.any() ? screws_.fit(curve, from, move_end_, motors()) : move_end_, motors());
  here_ = end_;
  spot_ = path_.at(path_.end());
  // The last part of a segment ends exactly where the program says.
  const bool whole = path_.end() >= curve.length().value();
  for (unsigned m = 0; m < motor_count_; ++m) {
    end_[m] = whole ? place_of(motors_[m], curve.end()) : path_.place(m, spot_);
  }
  spot_ = path_.at(from);
  moment_ = clock_.at(spot_.s);
  in_stretch_ = in_stretch_ && master_leads(spot_) && rate_fits(master_slope(spot_));
  if (in_stretch_) leads_until_ = leads_until(spot_);
}

// False: the part was the last of its move.
bool EventStream::start_next_part() {
  if (path_.end() >= move_end_) return false;
  start_part(path_.curve(), path_.end());
  return true;
}

double EventStream::rate_squared(double slope) const {
  return event_leader::rate_squared(slope, moment_.speed, moment_.acceleration, place_per_step);
}

// Whether the master still moves in its direction, and no motor is faster than the master.
bool EventStream::master_leads(const MotorPath::Spot& spot) const {
  const double slope = path_.slope(stretch_.master, spot) * stretch_.sign;
  if (slope <= 0) return false;
  for (unsigned m = 0; m < motor_count_; ++m) {
    if (std::fabs(path_.slope(m, spot)) > slope * event_leader::takeover) return false;
  }
  return true;
}

bool EventStream::still_leads(const MotorPath::Spot& spot) {
  if (spot.s <= leads_until_) return true;
  if (!master_leads(spot)) return false;
  leads_until_ = leads_until(spot);
  return true;
}

double EventStream::leads_until(const MotorPath::Spot& spot) const {
  return path_.leads_until(stretch_.master, stretch_.sign, event_leader::takeover, spot);
}

// The range of event rates in which no other division would be better.
EventStream::FittingRates EventStream::fitting_rates(std::int64_t grid) const {
  const auto squared = [](double x) { return x * x; };
  const double slow = slow_rate_ * static_cast<double>(grid);
  // If steps are never divided for slowness, a grid fits only if it is no finer than the path needs.
  const double before_coarser = slow == 0 ? -1 : squared(event_leader::rate_before_coarser * slow);
  return {.above = grid == finest_grid || slow == 0 ? -1 : squared(event_leader::rate_before_finer * slow),
          .most = grid == whole_step ? infinity : before_coarser};
}

bool EventStream::rate_fits(double slope) const {
  const double rate = rate_squared(slope);
  return rates_.hold(rate) || (rate > rates_.most && stretch_.grid >= coarsest_grid(stretch_.master));
}

// One step, or less on a curve of few steps: from event to event the direction must hardly change.
std::int64_t EventStream::coarsest_grid(unsigned motor) const {
  std::int64_t grid = whole_step;
  const double most = path_.reach(motor, spot_) * turn_an_event;
  while (static_cast<double>(grid) > most && grid > finest_grid) grid /= 2;
  return grid;
}

// The first line of the grid after `place`, in the direction of the master.
double EventStream::next_target(double place) const {
  const auto grid = static_cast<double>(stretch_.grid);
  const double along = stretch_.sign * place / grid;
  return stretch_.sign * (std::floor(along + 1e-6) + 1) * grid;
}

// The motor that is the first to get a certain distance away from here. The distance is one step, or less on a curve so
// small that motors turn back within a step.
EventStream::Fastest EventStream::fastest() const {
  Fastest best;
  for (double distance = place_per_step; distance >= smallest_distance; distance /= 4) {
    best = {};
    bool arrives = path_.is_straight();
    for (unsigned m = 0; m < motor_count_; ++m) {
      const double length = path_.travel(m, distance, spot_.s);
      if (distance > best.slope * length) best = {.motor = m, .slope = distance / length};
      arrives = arrives || (length < infinity && path_.is_turning(m));
    }
    if (arrives) break;
  }
  return best;
}

EventStream::Start EventStream::start_stretch(EventBuffer& events) {
  const auto [master, slope] = fastest();
  if (slope == 0) return Start::nothing_moves;
  stretch_ = {.master = master, .sign = path_.rises(master, spot_) ? 1 : -1, .grid = coarsest_grid(master)};
  double rate = std::sqrt(rate_squared(slope)) / static_cast<double>(stretch_.grid);
  for (; rate < slow_rate_ && stretch_.grid > finest_grid; rate *= 2) stretch_.grid /= 2;
  rates_ = fitting_rates(stretch_.grid);
  // Behind the last event, which is at a line: rounding may put the master before that line, where the path is slow.
  // The same line would be found again and again.
  const double place = path_.place(master, spot_);
  target_ = next_target(stretch_.sign > 0 ? std::max(place, here_[master]) : std::min(place, here_[master]));
  if (path_.crossing(master, target_, spot_).s == infinity) {
    // The master turns back before the next line. The first crossing is on the way back.
    const double turn = path_.turning_point(master, spot_.s);
    if (!(turn < path_.end())) return Start::nothing_moves;
    go_to(turn);
    return Start::turned;
  }
  events.restart(here_);
  in_stretch_ = true;
  leads_until_ = leads_until(spot_);
  return Start::done;
}

// A step may be due between the last event and the border between two stretches. Such a step gets an event here, at the
// border.
bool EventStream::push_border(EventBuffer& events) {
  double most = 0;
  bool due = false;
  for (unsigned m = 0; m < motor_count_; ++m) {
    const double moved = here_[m] - at_last_event_[m];
    due = due || std::floor(here_[m] / place_per_step) != std::floor(at_last_event_[m] / place_per_step);
    if (std::fabs(moved) <= most) continue;
    most = std::fabs(moved);
    stretch_ = {.master = m, .sign = moved > 0 ? 1 : -1, .grid = whole_step};
  }
  if (!due) return false;
  events.restart(at_last_event_);
  push(fixed_time(moment_.time), events);
  at_last_event_ = here_;
  return true;
}

// Two events are never too close for the board: where the master changes, the new one may have to wait.
std::int64_t EventStream::possible(std::int64_t time) {
  return last_event_ = std::max(time, last_event_ + shortest_interval_);
}

// Adds an event at which all motors are at `here_`.
void EventStream::push(std::int64_t time, EventBuffer& events) {
  events.push(possible(time), here_, motor_count_);
}

void EventStream::go_to(double s) {
  spot_ = path_.at(s);
  moment_ = clock_.at(s);
  for (unsigned m = 0; m < motor_count_; ++m) here_[m] = path_.place(m, spot_);
}

// A place just after the step at a line. Going up, a place on the line is after the step. Going down, only a place
// below the line is after the step.
double EventStream::behind_line(double target) const {
  return stretch_.sign < 0 ? target - 0.5 : target;
}

void EventStream::push_master(double target, const MotorPath::Spot& spot, EventBuffer& events) {
  moment_ = clock_.at(spot.s);
  spot_ = spot;
  for (unsigned m = 0; m < motor_count_; ++m) {
    here_[m] = at_last_event_[m] = m == stretch_.master ? target : path_.place(m, spot);
  }
  push(fixed_time(moment_.time), events);
  here_[stretch_.master] = at_last_event_[stretch_.master] = behind_line(target);
  target_ = target + stretch_.sign * static_cast<double>(stretch_.grid);
  in_stretch_ = rate_fits(master_slope(spot_));
}

// Does what the loop of fill() does for several events at once, while stretch and move last.
EventStream::Filled EventStream::fill_lanes(EventBuffer& events) {
  const unsigned master = stretch_.master;
  const double step = stretch_.sign * static_cast<double>(stretch_.grid);
  MotorPath::Spots ahead;
  path_.look_ahead(master, target_, step, spot_.s, ahead);
  if (ahead.count > 0 && ahead.s[0] > path_.end()) return Filled::to_end;
  std::size_t count = 0;
  while (count < ahead.count && ahead.s[count] <= path_.end() && still_leads(ahead[count])) ++count;
  if (count == 0) return Filled::nothing;

  Lanes slopes;
  path_.slopes(master, ahead, slopes);
  PhaseClock::Moments moments;
  std::array<std::int64_t, lane_count> times;
  std::size_t made = 0;
  bool fits = true;
  while (made < count && fits) {
    const std::size_t in_phase = clock_.at(ahead.s, made, count, moments);
    for (; made < in_phase && fits; ++made) {
      moment_ = moments[made];
      times[made] = possible(fixed_time(moment_.time));
      fits = rate_fits(std::fabs(slopes[made]));
    }
  }
  std::array<Lanes, max_motors> places;
  for (unsigned m = 0; m < motor_count_; ++m) path_.places(m, ahead, places[m]);
  for (std::size_t i = 0; i < made; ++i, target_ += step) places[master][i] = target_;
  events.push(times, places, made, motor_count_);
  for (unsigned m = 0; m < motor_count_; ++m) here_[m] = places[m][made - 1];
  here_[master] = behind_line(here_[master]);
  at_last_event_ = here_;
  spot_ = ahead[made - 1];
  in_stretch_ = fits;
  return Filled::some;
}

EventStream::Stop EventStream::finish_move() {
  const bool rests = clock_.ends_at_rest();
  advance(clock_.duration());
  in_move_ = false;
  return rests ? Stop::rest : Stop::move_end;
}

EventStream::Stop EventStream::fill(EventBuffer& events, std::size_t enough) {
  while (events.size() < enough) {
    if (!in_stretch_) {
      if (!events.empty() || push_border(events)) return Stop::stretch_end;
      const Start start = start_stretch(events);
      if (start == Start::turned || (start == Start::nothing_moves && start_next_part())) continue;
      if (start == Start::nothing_moves) return finish_move();
    }
    const Filled filled = fill_lanes(events);
    if (filled == Filled::some) continue;
    if (filled == Filled::to_end && start_next_part()) continue;
    if (filled == Filled::to_end) return finish_move();
    const MotorPath::Spot spot = path_.crossing(stretch_.master, target_, spot_);
    if (spot.s == infinity) {  // the master turns back first: choose again
      in_stretch_ = false;
      continue;
    }
    if (spot.s > path_.end()) {
      if (start_next_part()) continue;
      return finish_move();
    }
    // On a curve another motor may have become the fastest on the way.
    const bool leads = still_leads(spot);
    if (!leads && !events.empty()) {
      in_stretch_ = false;
      continue;
    }
    push_master(target_, spot, events);
    in_stretch_ = in_stretch_ && leads;
  }
  return Stop::full;
}

}  // namespace passo
