// What of a MotionDrive follows the spindle.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "passo/controller/motion_drive.hpp"

namespace passo {
namespace {

// A spindle is at speed when a turn takes as long as it should, or hardly less than the one before.
constexpr double near_speed = 0.1;
constexpr double steady = 0.02;
constexpr int most_turns = 1000;
// While it is waited for, an encoder is looked at so often; and it may stand so long, running up and in a thread.
constexpr Seconds between_looks{0.005};
constexpr Seconds longest_run_up{5};
constexpr Seconds longest_stand{0.25};
constexpr double counts_at_least = 8;
// A thread that begins later than by so many turns has no lead-in that makes up for it.
constexpr double latest_start = 0.25;
constexpr int sure_of_start = 3;
// And where the tool is off by so much of a turn behind its lead-in, the line is too slow to follow this spindle.
constexpr double most_missing = 0.1;
constexpr Seconds longest_lead{0.2};
constexpr std::size_t bytes_of_a_start = 460;  // twenty items

}  // namespace

void MotionDrive::use_encoder(int counts_per_turn) {
  encoder_ = SpindleEncoder(counts_per_turn, tick_rate_);
  if (refiller_) refiller_->guard_threads();
}

void MotionDrive::begin_following() {
  if (std::exchange(follows_, true)) return;
  encoder_.restart();
  follower_.restart();
  if (refiller_) commit_to_asked();
}

// At rest: until the spindle is at speed, and then until its index comes by.
void MotionDrive::await_index(const OutputState& outputs) {
  if (!encoder_.exists()) return;
  if (!refiller_) link_.drain();
  if (refiller_) rehearse_start();
  follows_ = false;
  begin_following();
  const double wanted = seconds_per_minute / outputs.revolutions_per_minute;
  SpindleReading begun;
  double before = 0;
  bool at_speed = false;
  for (int turns = 0; read_spindle();) {
    if (!mind_encoder(longest_run_up)) return rest_in_hold();  // where it rests already
    const SpindleReading& now = encoder_.now();
    const double turned = std::abs(now.turns - begun.turns);
    if (turned >= 1) {
      const double turn = (now.time - begun.time).value() / turned;
      at_speed = at_speed || std::abs(turn - wanted) < near_speed * wanted || std::abs(turn - before) < steady * turn ||
                 ++turns == most_turns;
      before = turn;
      begun = now;
    }
    const Seconds left = time_to_index(refiller_ ? link_.answer_time() + late_ : Seconds(0));
    encoder_known_ = encoder_known_ || encoder_.is_right();
    const bool begins = at_speed && encoder_known_ && encoder_.index() && left < 2 * between_looks;
    let_pass(begins ? left : between_looks);
    if (begins) return;
  }
}

// So long after what is sent the machine begins.
void MotionDrive::rehearse_start() {
  if (!link_.read_spindle()) return;
  const Seconds alone = link_.answer_time();
  const Seconds behind_a_start = link_.rehearse(bytes_of_a_start);
  if (late_ == Seconds(0)) late_ = std::max(behind_a_start - alone, Seconds(0));
}

// Told where it begins; so much time the answer has taken, and takes what is sent.
Seconds MotionDrive::time_to_index(Seconds answer) {
  const double speed = follower_.turns_a_second();
  if (!encoder_.index() || speed == 0) return Seconds(std::numeric_limits<double>::infinity());
  const double way = speed < 0 ? -1 : 1;
  const double ahead = encoder_.now().turns + speed * answer.value() - *encoder_.index();
  const double index = *encoder_.index() + way * (std::floor(way * ahead) + 1);
  looks_at_start_ = 0;
  index_time_ = encoder_.now().time + Seconds((index - encoder_.now().turns) / speed);
  follower_.begin(index);
  return *index_time_ - encoder_.now().time - answer;
}

bool MotionDrive::read_spindle() {
  if (!link_.read_spindle()) return false;
  note(*link_.take_turned());
  return true;
}

void MotionDrive::note(const Turned& turned) {
  encoder_.read(turned.spindle);
  follower_.read(encoder_.now());
}

// What was pulled last is followed by what is pulled next. Over a line it is what the answer behind the last refill
// tells, when that has come.
void MotionDrive::follow_spindle() {
  begin_following();
  if (!refiller_ && !link_.read_spindle()) return;
  const std::optional<Turned> turned = link_.take_turned();
  if (!turned) return;
  note(*turned);
  const Seconds ahead = refiller_ ? refiller_->ahead_of(*turned, encoder_.now().time) : committed();
  const bool by_place = follower_.lock() == SpindleLock::place;
  if (!mind_encoder(by_place ? longest_stand : longest_run_up)) return;
  if (index_time_) mind_start();
  if (refiller_ && by_place && std::abs(follower_.missing(ahead)) > most_missing) give_up(LinkError::thread_lost);
  if (tap_turns_ && follower_.turns_back(ahead)) {
    tap_turns_ = false;
    tap_brakes_ = true;
    planner_.stop();
  }
  if (const auto ratio = follower_.ratio(ahead)) planner_.set_spindle_ratio(*ratio);
}

// It has begun: by what the board tells later than it should, the next one is begun sooner.
void MotionDrive::mind_start() {
  if (refiller_) {
    if (!refiller_->began() || ++looks_at_start_ < sure_of_start) return;
    const Seconds late = *refiller_->began() - *index_time_;
    late_ = std::clamp(late_ + late, Seconds(0), longest_lead);
    if (std::abs(late.value() * follower_.turns_a_second()) > latest_start) give_up(LinkError::thread_lost);
  }
  index_time_.reset();
}

// A feed a revolution needs no index.
bool MotionDrive::mind_encoder(Seconds longest) {
  if (trouble_) return false;
  const bool wrong = follower_.lock() != SpindleLock::speed && encoder_.is_wrong();
  if (wrong) give_up(LinkError::encoder_wrong);
  if (!wrong && encoder_.stood() > longest + encoder_.time_of_counts(counts_at_least)) {
    give_up(LinkError::spindle_stands);
  }
  return !trouble_;
}

// Brakes on the path, and ends there.
void MotionDrive::give_up(LinkError error) {
  trouble_ = error;
  stop();
}

// At rest in a thread, whose next turn would not be where the ones before are.
bool MotionDrive::lose_thread() {
  refiller_->switch_outputs({});
  link_.fail(LinkError::thread_lost);
  state_ = State::ended;
  return false;
}

// On its way down: at the end of the thread the spindle is reversed, and the tool goes on with it.
void MotionDrive::watch_tap(const PlannedMove& move) {
  end_of_tap_ = move.segment.curve.at(move.to);
  if (tap_turns_ || tap_brakes_ || move.to < move.segment.reverse_at) return;
  tap_turns_ = true;
  OutputState outputs = outputs_;
  outputs.spindle = reversed(outputs.spindle);
  set_outputs(outputs);
}

// At rest, as the spindle does for a moment.
void MotionDrive::turn_tap(const Action& action) {
  set_outputs(action.outputs);
  link_.drain();
  tap_turns_ = false;
  *tap_rest_ = end_of_tap_;
  follower_.turn_round();
}

}  // namespace passo
