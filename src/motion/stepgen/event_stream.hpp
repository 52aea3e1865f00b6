// EventStream: converts planned moves into exact events. It chooses the master motor and the subdivision of its steps.
// Then it inverts the phases at each multiple of the grid.
//
// The master is the motor that moves fastest. The event rate is its step rate times the lowest power of two that brings
// it above a sixteenth of the board's highest rate or 10 kHz. So on a slow move the other motors are late by at most
// one short event. A stretch continues from move to move while its master leads and its rate fits: many short moves
// make segments as long as one long move does. Several events are computed at once (lanes.hpp). With fitting and
// simulation about 13 ns per event on a line, 30 ns on a cubic or an arc, 20 ns more with jerk.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "event_buffer.hpp"
#include "motor_path.hpp"
#include "phase_clock.hpp"
#include "screw_parts.hpp"

#include "passo/stepgen/step_generator.hpp"

namespace passo {

class EventStream {
 public:
  explicit EventStream(const StepOptions& options);

  // Why fill() stopped.
  enum class Stop : std::uint8_t {
    full,         // there are enough events for a segment
    stretch_end,  // the events of this stretch are complete; play them before filling again
    move_end,     // the move is finished; start the next one
    rest,         // the move is finished and ends in a stop
  };

  // Begins the next move. Call it only at the start, or after move_end or rest. `move` must exist until it is finished.
  void start_move(const PlannedMove& move);
  bool in_move() const { return in_move_; }
  // Call it when the current move has been copied to another address. `move` is the copy.
  void move_lives_in(const PlannedMove& move) {
    path_.curve_lives_in(move.segment.curve);
    clock_.move_lives_in(move);
  }
  // Adds events of the current move, until there are `enough`.
  Stop fill(EventBuffer& events, std::size_t enough);
  // Ends the stretch, so that the next event chooses its master again. Events in the buffer still belong to the old
  // stretch.
  void end_stretch() { in_stretch_ = false; }
  // Below this event rate the grid is subdivided. A sixteenth of the board's highest rate is used instead if that is
  // lower. 0: the grid is never subdivided at low speed.
  void divide_below(Hertz rate) { slow_rate_ = std::min(rate.value(), slowest_share_); }
  void wait(Seconds time) { advance(time.value()); }
  // Sets the time back between two moves. `time` is in the units of now().
  void go_back_to(std::int64_t time);

  const Stretch& stretch() const { return stretch_; }
  // The exact time at the end of the last move, in 1/65536 tick with half a tick added.
  std::int64_t now() const { return fixed_time(0); }
  // Returns the exact position of a motor at the end of the last move.
  double place_at_end(unsigned motor) const { return end_[motor]; }
  std::int64_t shortest_interval() const { return shortest_interval_; }
  AxisSet downs() const { return screws_.downs(); }

 private:
  enum class Start : std::uint8_t { done, turned, nothing_moves };

  enum class Filled : std::uint8_t { some, nothing, to_end };

  struct Fastest {
    unsigned motor = 0;
    double slope = 0;  // the largest |d position / ds| on the path
  };

  // Squares of rates, in the unit of rate_squared().
  struct FittingRates {
    double above = 0;
    double most = 0;
    bool hold(double rate) const { return rate > above && rate <= most; }
  };

  void start_part(const Curve& curve, double from);
  bool start_next_part();
  Fastest fastest() const;
  Start start_stretch(EventBuffer& events);
  bool push_border(EventBuffer& events);
  Filled fill_lanes(EventBuffer& events);
  double behind_line(double target) const;
  void push_master(double target, const MotorPath::Spot& spot, EventBuffer& events);
  void push(std::int64_t time, EventBuffer& events);
  std::int64_t possible(std::int64_t time);
  void go_to(double s);
  bool master_leads(const MotorPath::Spot& spot) const;
  double leads_until(const MotorPath::Spot& spot) const;
  bool still_leads(const MotorPath::Spot& spot);
  FittingRates fitting_rates(std::int64_t grid) const;
  bool rate_fits(double slope) const;
  double master_slope(const MotorPath::Spot& spot) const { return std::fabs(path_.slope(stretch_.master, spot)); }
  std::int64_t coarsest_grid(unsigned motor) const;
  double rate_squared(double slope) const;
  double next_target(double place) const;
  Stop finish_move();
  std::int64_t fixed_time(double seconds) const;
  void advance(double seconds);

  std::span<MotorRow> motors() { return {motors_.data(), motor_count_}; }

  std::array<MotorRow, max_motors> motors_;  // as in the current part of the move
  std::uint8_t motor_count_;
  double tick_rate_;
  std::int64_t shortest_interval_;
  double slowest_share_;  // slow_share of the board's highest rate; events/s
  double slow_rate_;      // events/s; below this rate the grid is subdivided

  // Start time of the current move, as whole ticks and a fraction, so that no precision is lost over hours.
  std::int64_t ticks_ = 0;
  double fraction_ = 0;

  MotorPath path_;  // up to the end of the current part of the move
  PhaseClock clock_;
  ScrewParts screws_;
  double move_end_ = 0;
  bool in_move_ = false;
  MotorPath::Spot spot_;  // the current position on the curve
  PhaseClock::Moment moment_;
  std::array<double, max_motors> here_{};  // exact positions at spot_
  std::array<double, max_motors> at_last_event_{};
  std::array<double, max_motors> end_{};  // at the end of the current part, or of the last move

  bool in_stretch_ = false;
  Stretch stretch_;
  FittingRates rates_;      // for the grid of the stretch
  double leads_until_ = 0;  // the s up to which the master is known to lead
  double target_ = 0;       // the next multiple of the grid that the master reaches
  std::int64_t last_event_ = INT64_MIN / 2;
};

}  // namespace passo
