#include "passo/spindle/spindle_controller.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "spindle_sentences.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

// Between two exchanges the bus must be silent for 3.5 characters; drives need a little longer.
constexpr Seconds between_exchanges{0.01};
constexpr Seconds between_readings{0.05};
constexpr Seconds between_readings_at_rest{0.2};
constexpr double standing_rpm = 60;
constexpr int good_readings = 2;
constexpr int most_refused = 3;
constexpr double slow = 0.5;
constexpr Seconds longest_slow{1};

std::string in_words(double rpm) {
  return fmt::format("{:.0f}", rpm);
}

bool is_command(VfdTask task) {
  return task < VfdTask::read_speed;
}

}  // namespace

SpindleController::SpindleController(Vfd& vfd, const SpindleBusDescription& bus, Clock clock)
    : vfd_(vfd), bus_(bus), clock_(std::move(clock)) {
  connection_.heard = clock_();
  next_reading_ = clock_();
}

void SpindleController::order(const SpindleOrder& wanted) {
  if (wanted == order_) return;
  order_ = wanted;
  begin_order();
}

void SpindleController::begin_order() {
  approach_ = {.since = clock_()};
}

// What the drive is to do: nothing after a fault, and no speed that the spindle must not have.
SpindleOrder SpindleController::wanted() const {
  if (!fault_.code.empty() || !order_.turns() || order_.revolutions_per_minute <= 0) return {};
  const double highest = bus_.highest_rpm > 0 ? bus_.highest_rpm : order_.revolutions_per_minute;
  return {.direction = order_.direction,
          .revolutions_per_minute =
              std::min(std::max(order_.revolutions_per_minute, bus_.lowest_rpm), std::max(highest, bus_.lowest_rpm))};
}

HostSpindleStatus SpindleController::status() const {
  const SpindleOrder target = wanted();
  const bool waits = order_.turns() && order_.revolutions_per_minute > 0;
  HostSpindleStatus status{.order = order_,
                           .answers = connection_.answers,
                           .at_speed = waits ? target.turns() && approach_.reached : true,
                           .revolutions_per_minute = readings_.rpm,
                           .current = readings_.current,
                           .load = readings_.load,
                           .fault = fault_};
  if (!status.load && status.current && bus_.rated_current > 0) status.load = *status.current / bus_.rated_current;
  return status;
}

bool SpindleController::can_be_cleared() const {
  return connection_.answers && readings_.fault_number == 0 && is_stopped();
}

bool SpindleController::clear_fault() {
  if (fault_.code.empty()) return connection_.answers;
  resets_ = readings_.fault_number != 0 && !readings_.was_reset;
  if (!can_be_cleared()) return false;
  fault_ = {};
  begin_order();
  return true;
}

Seconds SpindleController::step() {
  if (const std::optional<VfdTask> task = next_task()) {
    const auto reply = vfd_.exchange(*task, wanted().revolutions_per_minute);
    if (reply) {
      hear(*task, *reply);
    } else {
      miss(*task, reply.error());
    }
    check_speed();
    return between_exchanges;
  }
  check_speed();
  return std::max(next_reading_ - clock_(), between_exchanges);
}

std::optional<VfdTask> SpindleController::next_task() {
  if (std::exchange(resets_, false) && vfd_.can(VfdTask::reset_fault)) return VfdTask::reset_fault;
  const SpindleOrder target = wanted();
  const bool turns_back = target.turns() && told_direction_ == reversed(target.direction);
  // A drive that stays silent is also asked for its speed, so that it is heard when it returns.
  const bool is_silent = connection_.silent > 0 && turn_ % 2 == 1;
  if (!target.turns() || turns_back || !told_direction_) {
    if (told_direction_ != SpindleDirection::off && !is_silent) return VfdTask::stop;
  } else if (told_rpm_ != target.revolutions_per_minute) {
    return VfdTask::set_speed;
  } else if (told_direction_ != target.direction) {
    const bool may_turn = last_direction_ == SpindleDirection::off || last_direction_ == target.direction;
    if (may_turn) {
      connection_.may_turn = true;
      if (target.direction == SpindleDirection::clockwise) return VfdTask::run_forward;
      if (vfd_.can(VfdTask::run_reverse)) return VfdTask::run_reverse;
      fail(spindle_says::no_reverse.with());
      return {};
    }
  }
  return next_reading();
}

bool SpindleController::reads(VfdTask task) const {
  return vfd_.can(task) && !refuses_[static_cast<std::size_t>(task)];
}

// The speed every second time, and the others between.
std::optional<VfdTask> SpindleController::next_reading() {
  static constexpr std::array others = {VfdTask::read_fault, VfdTask::read_current, VfdTask::read_load};
  const Seconds now = clock_();
  if (now < next_reading_) return {};
  next_reading_ = now + (wanted().turns() ? between_readings : between_readings_at_rest);
  ++turn_;
  if (readings_.was_reset) return VfdTask::read_fault;
  if (turn_ % 2 == 0) return VfdTask::read_speed;
  const VfdTask other = others[turn_ / 2 % others.size()];
  return reads(other) ? other : VfdTask::read_speed;
}

void SpindleController::hear(VfdTask task, double value) {
  connection_ = {.answers = true, .may_turn = connection_.may_turn, .heard = clock_()};
  switch (task) {
    case VfdTask::set_speed: told_rpm_ = wanted().revolutions_per_minute; break;
    case VfdTask::run_forward: told_direction_ = last_direction_ = SpindleDirection::clockwise; break;
    case VfdTask::run_reverse: told_direction_ = last_direction_ = SpindleDirection::counterclockwise; break;
    case VfdTask::stop:
      told_direction_ = SpindleDirection::off;
      connection_.may_turn = false;
      told_rpm_.reset();  // a drive that was switched off and on has forgotten it
      break;
    case VfdTask::reset_fault: readings_.was_reset = true; break;
    case VfdTask::read_speed: hear_speed(value); break;
    case VfdTask::read_current: readings_.current = value; break;
    case VfdTask::read_load: readings_.load = value; break;
    case VfdTask::read_fault: {
      readings_.fault_number = static_cast<int>(value);
      readings_.was_reset = false;
      if (readings_.fault_number == 0) break;
      const std::string text = vfd_.fault_text(readings_.fault_number);
      fail(spindle_says::drive_fault.with(
          {{"number", std::to_string(readings_.fault_number)}, {"text", text.empty() ? "see its manual" : text}}));
      break;
    }
  }
}

void SpindleController::hear_speed(double rpm) {
  readings_.rpm = rpm;
  if (is_stopped() && rpm <= standing_rpm) last_direction_ = SpindleDirection::off;
  const SpindleOrder target = wanted();
  const double off = std::abs(rpm - target.revolutions_per_minute);
  const bool is_good = target.turns() && told_direction_ == target.direction &&
                       told_rpm_ == target.revolutions_per_minute &&
                       off <= bus_.tolerance * target.revolutions_per_minute;
  approach_.good = is_good ? approach_.good + 1 : 0;
  approach_.reached = approach_.reached || approach_.good >= good_readings;
}

void SpindleController::miss(VfdTask task, const VfdTrouble& trouble) {
  const Seconds now = clock_();
  if (trouble.kind == VfdTrouble::Kind::refused) {
    // An exception is an answer.
    connection_.answers = true;
    connection_.heard = now;
    connection_.silent = 0;
    if (!is_command(task) && task != VfdTask::read_speed) {
      refuses_[static_cast<std::size_t>(task)] = true;
    } else if (++connection_.refused >= most_refused) {
      fail(spindle_says::refused.with({{"number", std::to_string(trouble.exception)}}));
    }
    return;
  }
  ++connection_.silent;
  if (connection_.silent < most_silent_exchanges && now - connection_.heard < longest_silence) return;
  connection_.answers = false;
  if (wanted().turns() || connection_.may_turn) {
    const SentenceArguments arguments = {
        {"device", bus_.device}, {"address", std::to_string(bus_.address)}, {"why", trouble.words}};
    switch (trouble.kind) {
      case VfdTrouble::Kind::port: fail(spindle_says::port.with(arguments)); break;
      case VfdTrouble::Kind::bad_reply: fail(spindle_says::bad_answer.with(arguments)); break;
      default: fail(spindle_says::no_answer.with(arguments));
    }
  }
  // It may have been switched off and on, or turned by hand.
  told_direction_.reset();
  told_rpm_.reset();
  ++turn_;
}

void SpindleController::check_speed() {
  const SpindleOrder target = wanted();
  if (!target.turns()) return;
  const Seconds now = clock_();
  const std::string goal = in_words(target.revolutions_per_minute);
  if (!approach_.reached) {
    if (now - approach_.since <= bus_.reach) return;
    return fail(spindle_says::not_reached.with(
        {{"wanted", goal}, {"time", fmt::format("{:g}", bus_.reach.value())}, {"rpm", in_words(readings_.rpm)}}));
  }
  if (readings_.rpm >= slow * target.revolutions_per_minute) {
    approach_.slow_since.reset();
  } else if (!approach_.slow_since) {
    approach_.slow_since = now;
  } else if (now - *approach_.slow_since > longest_slow) {
    fail(spindle_says::slowed.with({{"wanted", goal}, {"rpm", in_words(readings_.rpm)}}));
  }
}

// The first fault stays: what follows is its consequence.
void SpindleController::fail(Sentence why) {
  if (fault_.code.empty()) fault_ = std::move(why);
}

}  // namespace passo
