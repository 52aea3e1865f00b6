#include "passo/drive/spindle_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "passo/link/board_port.hpp"

namespace passo {
namespace {

// A spindle is at speed when a turn takes as long as ordered, or nearly as long as the turn before.
constexpr double near_speed = 0.1;
constexpr double steady = 0.02;
constexpr int most_turns = 1000;
// How often the tracker reads the encoder while it waits for the spindle, and how long the spindle may stand while
// running up and in a thread.
constexpr Seconds between_looks{0.005};
constexpr Seconds longest_run_up{5};
constexpr Seconds longest_stand{0.25};
// For how long the spindle may be faster than the axes can follow.
constexpr Seconds longest_outrun{0.05};
constexpr double counts_at_least = 8;
// A thread that begins more than this many turns late has no lead-in long enough to make up for the delay.
constexpr double latest_start = 0.25;
constexpr int sure_of_start = 3;
// If the tool is off by this part of a turn after its lead-in, the line or an axis is too slow to follow this spindle.
constexpr double most_missing = 0.1;
constexpr Seconds longest_lead{0.2};
constexpr std::size_t bytes_of_a_start = 460;  // twenty items

}  // namespace

SpindleTracker::SpindleTracker(const Stages& stages, const MotionLimits& limits, int counts_per_turn, Hertz clock)
    : stages_(stages), encoder_(counts_per_turn, clock), follower_(limits) {}

void SpindleTracker::begin_following() {
  if (std::exchange(follows_, true)) return;
  encoder_.restart();
  follower_.restart();
  outruns_since_.reset();
  stages_.feed.attend(Attention::follows);
}

bool SpindleTracker::let_go() {
  return follower_.lock() == SpindleLock::none && follows_ && !index_time_ && !(follows_ = false);
}

// Over a line, the delay of what is sent is measured first.
void SpindleTracker::begin_await(double revolutions_per_minute) {
  wanted_ = seconds_per_minute / revolutions_per_minute;
  turn_begun_ = {};
  turn_before_ = 0;
  turns_ = 0;
  at_speed_ = begins_ = false;
  looks_at_ = Seconds(0);
  step_ = stages_.feed.is_remote() ? AwaitStep::measure : AwaitStep::measured_loaded;
  alone_ = stages_.link.answer_time();
}

bool SpindleTracker::await_index() {
  Link& link = stages_.link;
  while (!trouble_ && !link.error()) {
    if (!link.settled() || looks_at_ - link.now() > hardly_any) return false;
    switch (step_) {
      case AwaitStep::measure:
        link.read_spindle();
        step_ = AwaitStep::measured_alone;
        break;
      case AwaitStep::measured_alone:
        alone_ = link.answer_time();
        link.rehearse(bytes_of_a_start);
        step_ = AwaitStep::measured_loaded;
        break;
      case AwaitStep::measured_loaded:
        if (late_ == Seconds(0)) late_ = std::max(link.answer_time() - alone_, Seconds(0));
        follows_ = false;
        begin_following();
        step_ = AwaitStep::ask;
        break;
      case AwaitStep::ask:
        if (begins_) return true;
        link.read_spindle();
        step_ = AwaitStep::answered;
        break;
      case AwaitStep::answered:
        if (const auto turned = link.take_turned()) update(*turned);
        find_index();
        step_ = AwaitStep::ask;
        break;
    }
  }
  return true;
}

void SpindleTracker::find_index() {
  if (!check_encoder(longest_run_up)) return;
  const SpindleReading& now = encoder_.now();
  const double turned = std::abs(now.turns - turn_begun_.turns);
  if (turned >= 1) {
    const double turn = (now.time - turn_begun_.time).value() / turned;
    at_speed_ = at_speed_ || std::abs(turn - wanted_) < near_speed * wanted_ ||
                std::abs(turn - turn_before_) < steady * turn || ++turns_ == most_turns;
    turn_before_ = turn;
    turn_begun_ = now;
  }
  const bool remote = stages_.feed.is_remote();
  const Seconds left = time_to_index(remote ? stages_.link.answer_time() + late_ : Seconds(0));
  encoder_known_ = encoder_known_ || encoder_.is_right();
  begins_ = at_speed_ && encoder_known_ && encoder_.index() && left < 2 * between_looks;
  looks_at_ = stages_.link.now() + (begins_ ? left : between_looks);
}

// The time until the motion has to be sent. The follower is told the index at which the thread begins. `answer`: the
// time that the answer took, which is also the time that sending takes.
Seconds SpindleTracker::time_to_index(Seconds answer) {
  const double speed = follower_.turns_per_second();
  if (!encoder_.index() || speed == 0) return Seconds(std::numeric_limits<double>::infinity());
  const double way = speed < 0 ? -1 : 1;
  const double ahead = encoder_.now().turns + speed * answer.value() - *encoder_.index();
  const double index = *encoder_.index() + way * (std::floor(way * ahead) + 1);
  looks_at_start_ = 0;
  index_time_ = encoder_.now().time + Seconds((index - encoder_.now().turns) / speed);
  follower_.begin(index);
  return *index_time_ - encoder_.now().time - answer;
}

void SpindleTracker::update(const Turned& turned) {
  encoder_.read(turned.spindle);
  follower_.read(encoder_.now());
}

// Sets the ratio for the motion that is pulled next. Over a line, the follower uses the answer after the last refill,
// once that answer has come.
bool SpindleTracker::follow() {
  begin_following();
  const bool remote = stages_.feed.is_remote();
  if (!remote) {
    if (!std::exchange(asked_, true)) stages_.link.read_spindle();
    if (!stages_.link.settled()) return false;
    asked_ = false;
  }
  const std::optional<Turned> turned = stages_.link.take_turned();
  if (!turned) return true;
  update(*turned);
  const Seconds ahead = remote ? stages_.feed.ahead_of(*turned, encoder_.now().time) : stages_.feed.ahead();
  const bool by_place = follower_.lock() == SpindleLock::place;
  if (!check_encoder(by_place ? longest_stand : longest_run_up)) return true;
  if (index_time_) check_start();
  if (by_place) check_lag(ahead);
  if (turn_expected_ && follower_.is_reversing(ahead)) {
    turn_expected_ = false;
    turned_back_ = true;
  }
  if (const auto ratio = follower_.ratio(ahead)) stages_.planner.set_spindle_ratio(*ratio);
  return true;
}

// A single reading may be wrong, so the spindle must be too fast for a while.
void SpindleTracker::check_lag(Seconds ahead) {
  const Seconds time = encoder_.now().time;
  const bool outruns = follower_.outruns_axes(ahead);
  outruns_since_ = outruns ? std::optional(outruns_since_.value_or(time)) : std::nullopt;
  if (outruns && time - *outruns_since_ > longest_outrun) trouble_ = LinkError::thread_outrun;
  if (trouble_ || std::abs(follower_.missing(ahead)) <= most_missing) return;
  trouble_ = outruns || !stages_.feed.is_remote() ? LinkError::thread_outrun : LinkError::thread_lost;
}

// The thread has begun. The next thread is begun sooner by as much as the board tells that this one was late.
void SpindleTracker::check_start() {
  if (stages_.feed.is_remote()) {
    const auto began = stages_.feed.began();
    if (!began || ++looks_at_start_ < sure_of_start) return;
    const Seconds late = *began - *index_time_;
    late_ = std::clamp(late_ + late, Seconds(0), longest_lead);
    if (std::abs(late.value() * follower_.turns_per_second()) > latest_start) trouble_ = LinkError::thread_lost;
  }
  index_time_.reset();
}

// Feed per revolution needs no index.
bool SpindleTracker::check_encoder(Seconds longest) {
  if (trouble_) return false;
  if (follower_.lock() != SpindleLock::speed && encoder_.is_wrong()) {
    trouble_ = LinkError::encoder_wrong;
  } else if (encoder_.stood() > longest + encoder_.time_of_counts(counts_at_least)) {
    trouble_ = LinkError::spindle_stands;
  }
  return !trouble_;
}

void SpindleTracker::reverse() {
  turn_expected_ = false;
  follower_.reverse();
}

}  // namespace passo
