#include "passo/link/handshake.hpp"

#include <sstream>

namespace passo {

void Handshake::begin(const Greeting& greeting) {
  wanted_ = greeting;
  set_up_ = {};
  reply_.reset();
  phase_ = Phase::greeting;
}

void Handshake::hang_up() {
  reply_.reset();
  phase_ = Phase::before_hello;
}

void Handshake::rename(std::uint16_t session) {
  wanted_.session = session;
  phase_ = Phase::naming;
}

std::optional<LinkError> Handshake::handle(const PinSetup& setup) {
  set_up_ = setup;
  if (!is_set_up()) return undone_setup() != PinSetup{} ? LinkError::cannot_set_up : LinkError::cannot_time;
  reply_.reset();  // an answer to a hello before
  return {};
}

// Levels are as wanted or not. Times may be longer, and events may come sooner.
bool Handshake::is_set_up() const {
  PinSetup done = set_up_;
  done.timing = wanted_.setup.timing;
  return done == wanted_.setup &&
         (wanted_.setup.timing == StepTiming{} || suffices(set_up_.timing, wanted_.setup.timing));
}

PinSetup Handshake::undone_setup() const {
  const PinSetup& setup = wanted_.setup;
  return {.inputs = static_cast<std::uint16_t>(setup.inputs & ~set_up_.inputs),
          .steps = static_cast<std::uint8_t>(setup.steps & ~set_up_.steps),
          .outputs = static_cast<std::uint8_t>(setup.outputs & ~set_up_.outputs),
          .drivers_rest = set_up_.drivers_rest == 0 ? setup.drivers_rest : std::uint8_t{0},
          .alarms = static_cast<std::uint16_t>(setup.alarms & ~set_up_.alarms),
          .filter = set_up_.filter == 0 ? setup.filter : std::uint8_t{0}};
}

void Handshake::handle(const HelloReply& reply) {
  if (phase_ == Phase::greeting) reply_ = reply;
}

std::optional<LinkError> Handshake::go_on() {
  if (phase_ != Phase::greeting || !reply_) return {};
  if (reply_->version != protocol_version) return LinkError::wrong_version;
  if (!is_set_up()) {
    reply_.reset();
    return {};
  }
  if (reply_->motors < wanted_.motors) return LinkError::too_few_motors;
  // The answer to the number tells how the switches are.
  phase_ = wanted_.session != 0 || wanted_.setup != PinSetup{} ? Phase::naming : Phase::ready;
  return {};
}

void Handshake::handle(const BoardStatus& status) {
  if (phase_ == Phase::naming && status.session == wanted_.session) phase_ = Phase::ready;
}

bool suffices(const StepTiming& given, const StepTiming& needed) {
  return given.pulse >= needed.pulse && given.set_up >= needed.set_up && given.hold >= needed.hold &&
         (needed.event_ticks == 0 || given.event_ticks <= needed.event_ticks);
}

std::string words_of_timing(const StepTiming& given, const StepTiming& needed, double clock) {
  constexpr double sixteenths = 16;
  const auto number = [](double value) {
    std::ostringstream out;
    out << value;
    return out.str();
  };
  const auto too_short = [&](const char* what, const char* key, std::uint8_t gives, std::uint8_t needs) {
    return std::string(what) + " of at most " + number(gives / sixteenths) + " us, and " + key + " = " +
           number(needs / sixteenths) + " of the machine file is longer [board.step-pulse]";
  };
  if (given.pulse < needed.pulse) return too_short("step pulses", "step_pulse_us", given.pulse, needed.pulse);
  if (given.set_up < needed.set_up) {
    return too_short("a direction set-up time", "direction_setup_us", given.set_up, needed.set_up);
  }
  if (given.hold < needed.hold) {
    return too_short("a direction hold time", "direction_hold_us", given.hold, needed.hold);
  }
  const std::string rate = std::to_string(static_cast<long>(clock / given.event_ticks));
  return "at most " + rate + " events/s with step pulses of " + number(needed.pulse / sixteenths) +
         " us and directions set " + number(needed.set_up / sixteenths) +
         " us before a step, and max_event_rate_hz of the machine file is higher: lower max_event_rate_hz to " + rate +
         " or less [board.event-rate]";
}

std::string words_of_setup(const PinSetup& setup) {
  std::string words;
  const auto add = [&](bool has, const std::string& word) {
    if (has) words += (words.empty() ? "" : ", ") + word;
  };
  for (unsigned i = 0; i < 8; ++i) add((setup.inputs >> i & 1U) != 0, "limit " + std::to_string(i + 1));
  add((setup.inputs & input_probe) != 0, "probe");
  add((setup.inputs & input_door) != 0, "door");
  add((setup.inputs & input_emergency_stop) != 0, "emergency_stop");
  add((setup.inputs & input_hold) != 0, "feed_hold");
  add((setup.inputs & input_start) != 0, "cycle_start");
  add(setup.steps != 0, "step");
  add((setup.outputs & inverted_enable) != 0, "driver_enable");
  add((setup.outputs & spindle_on) != 0, "spindle");
  add((setup.outputs & spindle_reverse) != 0, "spindle_reverse");
  add((setup.outputs & mist_on) != 0, "mist");
  add((setup.outputs & flood_on) != 0, "flood");
  add(setup.drivers_rest != 0, "drivers_off_after_s");
  for (unsigned i = 0; i < 8; ++i) add((setup.alarms >> i & 1U) != 0, "alarm at limit " + std::to_string(i + 1));
  add((setup.alarms & input_hold) != 0, "alarm at feed_hold");
  add((setup.alarms & input_start) != 0, "alarm at cycle_start");
  add(setup.filter != 0, "filter_us");
  return words;
}

}  // namespace passo
