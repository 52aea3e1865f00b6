#include "passo/stepgen/step_generator.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <tuple>
#include <utility>

#include "board_model.hpp"
#include "event_stream.hpp"
#include "power_parts.hpp"
#include "segment_fitter.hpp"

#include "passo/base/ensure.hpp"

namespace passo {

class StepGenerator::Implementation {
 public:
  Implementation(Source<MotionItem>& motion, const StepOptions& options)
      : motion_(&motion),
        motors_(options.kinematics.motor_count()),
        tick_rate_(options.clock.tick_rate),
        stream_(options),
        board_(options.kinematics.motor_count()),
        fitter_(options.kinematics.motor_count(), stream_.shortest_interval(), options.bends) {
    const MotorPosition start = options.kinematics.motors(options.start, options.downs);
    for (unsigned m = 0; m < motors_; ++m) board_.set_steps(m, std::llround(start[m]));
    if (options.place) board_.set_place(*options.place);
  }

  void limit_waiting_to(Seconds time) {
    longest_wait_ = std::isfinite(time.value()) ? std::llround(tick_rate_ * time * whole_tick) : INT64_MAX;
  }

  void be_exact_to(const Exactness& exactness) {
    exactness_ = exactness;
    fitter_.loosen_to(exactness.one_in, static_cast<unsigned>(exactness.longest_segment));
    stream_.divide_below(exactness.least_rate);
  }

  void assume(const Implementation& other) {
    const auto own = std::tuple(motion_, longest_wait_, exactness_);
    *this = other;
    std::tie(motion_, longest_wait_, exactness_) = own;
    be_exact_to(exactness_);
    finished_ = false;
    if (stream_.in_move()) stream_.move_lives_in(parts_.part_of(std::get<PlannedMove>(motion_item_)));
  }

  bool ends_at_rest() const { return rests_; }
  bool at_rest() const { return rests_ && !play_ && !rest_ && !action_ && !switches_ && !stream_.in_move(); }

  bool waits_at_rest() const { return rest_ && !play_; }

  Seconds cut_dwell() {
    if (!waits_at_rest()) return Seconds(0);
    const std::int64_t left = std::max<std::int64_t>(stream_.now() - board_.time(), 0);
    stream_.go_back_to(stream_.now() - left);
    return Seconds(static_cast<double>(left) / whole_tick / tick_rate_.value());
  }
  BoardPosition place() const { return board_.place(); }
  AxisSet downs() const { return stream_.downs(); }

  bool next(BoardItem& item) {
    for (;;) {
      if (play_ && fit(item)) return true;
      play_ = false;
      if (std::exchange(switches_, false)) {
        events_.show_hidden();
        play_ = !events_.empty();
        item = outputs_;
        return true;
      }
      if (rest_) {
        if (come_to_rest(item)) return true;
        rest_ = false;
      }
      if (action_) {
        item = *action_;
        action_.reset();
        return true;
      }
      if (!go_on()) return false;
    }
  }

 private:
  // Makes one segment of waiting events. Returns false if there are none, or so few that more could still make the
  // segment longer.
  bool fit(BoardItem& item) {
    if (events_.empty() || (more_ && !enough())) return false;
    const unsigned used = fitter_.fit(events_, stream_.stretch(), board_, last_);
    if (used == 0) return wait_until(events_.time(0), item);
    events_.drop(used);
    return send(last_, item);
  }

  // Whether there are events for the longest segment and one more, or events as far ahead as may be waited for.
  bool enough() const { return events_.size() > fitter_.longest() || stream_.now() - board_.time() >= longest_wait_; }

  bool send(const BoardSegment& segment, BoardItem& item) {
    // And BoardSession takes no other.
    ensure(segment.events > 0 && segment.events <= most_events && std::abs(segment.change) <= largest_change);
    board_.play(segment);
    item = segment;
    return true;
  }

  // Gives events without steps, because the time is too long for one interval. After them, the time left fits one
  // interval.
  bool wait_until(std::int64_t time, BoardItem& item) {
    constexpr std::int64_t idle = 32768 * whole_tick;
    constexpr int longest_idle = 255;
    const std::int64_t gap = time - board_.time();
    // With exact times, a wait has no more events than a segment may have. A dwell that is cut short ends with the
    // segment that is played.
    const std::int64_t most =
        std::min<std::int64_t>(exactness_.one_in > 0 ? most_events : fitter_.longest(), longest_idle);
    const std::int64_t events = std::clamp<std::int64_t>(gap / idle - 1, 1, most);
    return send(without_steps(static_cast<std::uint16_t>(events), std::min(idle, gap)), item);
  }

  BoardSegment without_steps(std::uint16_t events, std::int64_t interval) {
    last_ = BoardSegment{
        .events = events, .directions = last_.directions, .interval = static_cast<std::uint32_t>(interval)};
    for (unsigned m = 0; m < motors_; ++m) set_increment(last_, m, 1, 0);
    return last_;
  }

  // At a rest: brings every motor to its place at the programmed end, and the board's time to the path's time.
  bool come_to_rest(BoardItem& item) {
    std::array<std::int64_t, max_motors> missing{};
    bool moves = false;
    for (unsigned m = 0; m < motors_; ++m) {
      missing[m] = rest_place(stream_.place_at_end(m)) - board_.position(m);
      moves = moves || missing[m] != 0;
    }
    const std::int64_t gap = stream_.now() - board_.time();
    const std::int64_t shortest = stream_.shortest_interval();
    if (!moves && (gap < shortest || !exactness_.ends_in_time)) return false;
    if (gap > 65535 * whole_tick) return wait_until(stream_.now(), item);
    BoardSegment segment = without_steps(1, std::max(gap, shortest));
    for (unsigned m = 0; m < motors_; ++m) {
      if (missing[m] == 0) continue;
      const int sign = missing[m] > 0 ? 1 : -1;
      segment.directions = static_cast<std::uint8_t>(segment.directions & ~(1U << m));
      segment.flips = static_cast<std::uint8_t>(segment.flips & ~(1U << m));
      set_increment(segment, m, sign, std::min<std::int64_t>(std::abs(missing[m]), whole_step));
    }
    last_ = segment;
    return send(segment, item);
  }

  // Pulls motion until there are events to play, a rest to come to, or an action to pass on. Returns false at the end.
  bool go_on() {
    if (!stream_.in_move()) {
      const bool has_part = next_part();
      if (!has_part && !motion_->next(motion_item_)) return finish();
      if (const auto* action = std::get_if<Action>(&motion_item_)) {
        apply(*action);
        return true;
      }
      if (start_move(has_part)) return true;
    }
    switch (stream_.fill(events_, fitter_.longest() + 1)) {
      case EventStream::Stop::full: more_ = play_ = true; break;
      case EventStream::Stop::stretch_end:
        more_ = false;
        play_ = true;
        break;
      case EventStream::Stop::move_end:
        more_ = true;
        play_ = enough();
        break;
      case EventStream::Stop::rest:
        switch_laser_off();
        stream_.end_stretch();
        more_ = false;
        play_ = rest_ = rests_ = true;
        break;
    }
    return true;
  }

  // Starts the next part, or the move just pulled. Returns true if the outputs change there.
  bool start_move(bool has_part) {
    const auto& whole = std::get<PlannedMove>(motion_item_);
    if (!has_part) {
      ensure(whole.phase_count > 0 && whole.from() <= whole.to);  // as Planner hands it on
      parts_.begin(whole, exactness_.power_levels);
    }
    const PlannedMove& move = parts_.part_of(whole);
    stream_.start_move(move);
    rests_ = false;
    return change_outputs(move.segment.outputs);
  }

  bool next_part() {
    const auto* const whole = std::get_if<PlannedMove>(&motion_item_);
    return whole != nullptr && parts_.next(*whole, exactness_.power_levels);
  }

  // All events so far are played first. The stretch goes on after the change.
  bool change_outputs(const PathOutputs& wanted) {
    const PathOutputs outputs{.power = wanted.power, .switches = wanted.switches ? wanted.switches : outputs_.switches};
    if (outputs == outputs_) return false;
    outputs_ = outputs;
    more_ = false;
    play_ = switches_ = true;
    return true;
  }

  // With the last step, and not with the last event: the last part of a step takes some milliseconds.
  void switch_laser_off() {
    if (change_outputs({})) events_.hide_events_without_steps(motors_);
  }

  void apply(const Action& action) {
    change_outputs({.switches = action.switches});
    stream_.end_stretch();
    stream_.wait(action.dwell);
    more_ = false;
    play_ = rest_ = rests_ = true;  // an action always comes at rest, even if rounding has left some speed
    action_ = action;
  }

  bool finish() {
    if (finished_) return false;
    finished_ = true;
    switch_laser_off();
    stream_.end_stretch();
    more_ = false;
    play_ = rest_ = rests_ = true;
    return true;
  }

  Source<MotionItem>* motion_;
  std::uint8_t motors_;
  Hertz tick_rate_;
  EventStream stream_;
  EventBuffer events_;
  BoardModel board_;
  SegmentFitter fitter_;
  MotionItem motion_item_;
  BoardSegment last_;
  std::int64_t longest_wait_ = INT64_MAX;  // 1/65536 tick
  Exactness exactness_;

  bool play_ = false;  // events wait to be played
  bool more_ = false;  // more events of the same stretch may follow
  bool rest_ = false;  // after the events, the motors come to rest
  bool rests_ = true;  // all motion pulled so far ends at rest
  bool finished_ = false;
  std::optional<Action> action_;  // to be passed on after the rest
  PathOutputs outputs_;           // of the motion pulled so far
  bool switches_ = false;         // outputs_ follow the events
  PowerParts parts_;              // of the move, where the power follows the speed
};

StepGenerator::StepGenerator(Source<MotionItem>& motion, const StepOptions& options)
    : implementation_(std::make_unique<Implementation>(motion, options)) {}
StepGenerator::~StepGenerator() = default;

bool StepGenerator::next(BoardItem& item) {
  return implementation_->next(item);
}

void StepGenerator::limit_waiting_to(Seconds time) {
  implementation_->limit_waiting_to(time);
}
void StepGenerator::be_exact_to(const Exactness& exactness) {
  implementation_->be_exact_to(exactness);
}
void StepGenerator::assume(const StepGenerator& other) {
  implementation_->assume(*other.implementation_);
}
bool StepGenerator::ends_at_rest() const {
  return implementation_->ends_at_rest();
}
bool StepGenerator::waits_at_rest() const {
  return implementation_->waits_at_rest();
}
Seconds StepGenerator::cut_dwell() {
  return implementation_->cut_dwell();
}
BoardPosition StepGenerator::place() const {
  return implementation_->place();
}
AxisSet StepGenerator::downs() const {
  return implementation_->downs();
}
bool StepGenerator::at_rest() const {
  return implementation_->at_rest();
}

}  // namespace passo
