// BoardSession: questions before the hello, the hello itself, and the session's number.
#include <cassert>
#include <sstream>

#include "passo/link/board_session.hpp"

namespace passo {

void BoardSession::inquire(Question question) {
  assert(question == Question::about || question == Question::status);
  about_.reset();
  status_.reset();
  answered_ = true;  // earlier questions no longer count
  await(question);
}

void BoardSession::greet(const Greeting& greeting) {
  assert(greeting.motors > 0);
  forget_what_was();
  motors_ = greeting.motors;
  session_ = greeting.session;
  silence_ = greeting.silence;
  setup_ = greeting.setup;
  set_up_ = {};
  twins_.set(greeting.pairs);
  greeting_ = greeting.number;
  sent_ = on_wire_ = taken_ = executed_ = asked_behind_ = greeting_;
  decoder_.set_motors(motors_);
  sent_segments_.begin(motors_);
  progressed_ = heard_ = port_.elapsed();
  phase_ = Phase::greeting;
  if (is_set_up()) return say_hello();
  // The hello waits for the answer: the board looks at its switches when it is greeted.
  greeted_ = quiet_since_ = port_.elapsed();
  say(setup_, std::uint8_t{0});
}

// Forgets everything of the conversation so far, including an error.
void BoardSession::forget_what_was() {
  board_.reset();
  error_.reset();
  awaited_.reset();
  turned_.reset();
  rehearsed_.reset();
  kept_.clear();
  burst_ = 0;
  time_a_frame_ = Seconds(0);
  standstill_.reset();
  probe_ = {};
  usual_question_ = last_question_ = Question::status;
  answered_ = true;
  rests_ = repeating_ = question_waits_ = outputs_timed_out_ = false;
  refusals_ = doubts_ = free_ = 0;
  pressed_ = stopped_by_ = 0;
}

void BoardSession::hang_up() {
  forget_what_was();
  sent_ = on_wire_ = taken_ = asked_behind_ = executed_;  // nothing is under way any more
  phase_ = Phase::before_hello;
  decoder_.set_motors(max_motors);
}

// The setup counts for one hello. A board of another version knows no setup, and answers the hello.
void BoardSession::say_hello() {
  greeted_ = quiet_since_ = port_.elapsed();
  if (setup_ != PinSetup{}) say(setup_, std::uint8_t{0});
  say(Hello{.motors = motors_}, greeting_);
}

void BoardSession::take(const PinSetup& setup) {
  if (phase_ != Phase::greeting || is_set_up()) return;
  set_up_ = setup;
  if (!is_set_up()) {
    const bool lacks_pins = undone_setup() != PinSetup{};
    error_ = lacks_pins ? LinkError::cannot_set_up : LinkError::cannot_time;
    return;
  }
  board_.reset();  // an answer to a hello before
  say_hello();
}

// Levels are as wanted or not. Times may be longer, and events may come sooner.
bool BoardSession::is_set_up() const {
  PinSetup done = set_up_;
  done.timing = setup_.timing;
  return done == setup_ && (setup_.timing == StepTiming{} || suffices(set_up_.timing, setup_.timing));
}

bool suffices(const StepTiming& given, const StepTiming& needed) {
  return given.pulse >= needed.pulse && given.set_up >= needed.set_up && given.hold >= needed.hold &&
         (needed.event_ticks == 0 || given.event_ticks <= needed.event_ticks);
}

PinSetup BoardSession::undone_setup() const {
  return {.inputs = static_cast<std::uint16_t>(setup_.inputs & ~set_up_.inputs),
          .steps = static_cast<std::uint8_t>(setup_.steps & ~set_up_.steps),
          .outputs = static_cast<std::uint8_t>(setup_.outputs & ~set_up_.outputs),
          .drivers_rest = set_up_.drivers_rest == 0 ? setup_.drivers_rest : std::uint8_t{0},
          .alarms = static_cast<std::uint16_t>(setup_.alarms & ~set_up_.alarms),
          .filter = set_up_.filter == 0 ? setup_.filter : std::uint8_t{0}};
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
           number(needs / sixteenths) + " of the machine file asks for more [board.step-pulse]";
  };
  if (given.pulse < needed.pulse) return too_short("step pulses", "step_pulse_us", given.pulse, needed.pulse);
  if (given.set_up < needed.set_up) {
    return too_short("a set-up time of directions", "direction_setup_us", given.set_up, needed.set_up);
  }
  if (given.hold < needed.hold) {
    return too_short("a hold time of directions", "direction_hold_us", given.hold, needed.hold);
  }
  const std::string rate = std::to_string(static_cast<long>(clock / given.event_ticks));
  return "at most " + rate + " events a second with step pulses of " + number(needed.pulse / sixteenths) +
         " us and directions set " + number(needed.set_up / sixteenths) +
         " us before a step, and max_event_rate_hz of the machine file asks for more: lower max_event_rate_hz to " +
         rate + " or less [board.event-rate]";
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

void BoardSession::name_session(std::uint16_t number) {
  assert(number != 0 && !busy());
  session_ = number;
  phase_ = Phase::naming;
  progressed_ = port_.elapsed();
  say_session();
}

void BoardSession::say_session() {
  greeted_ = quiet_since_ = port_.elapsed();
  say(Session{.number = session_, .silence = silence_}, std::uint8_t{0});
  ask(Question::status);
}

// Goes on with the greeting if the answer that it waits for has come.
void BoardSession::look_at_greeting() {
  if (phase_ == Phase::greeting && board_) {
    free_ = board_->capacity;
    if (board_->version != protocol_version) {
      error_ = LinkError::wrong_version;
    } else if (!is_set_up()) {
      board_.reset();
    } else if (board_->motors < motors_) {
      error_ = LinkError::too_few_motors;
    } else if (session_ != 0 || setup_ != PinSetup{}) {  // the answer tells how the switches are
      phase_ = Phase::naming;
      progressed_ = port_.elapsed();
      status_.reset();
      say_session();
    } else {
      phase_ = Phase::ready;
    }
  }
  if (phase_ == Phase::naming && status_ && status_->session == session_) phase_ = Phase::ready;
  news_ = news_ || phase_ == Phase::ready;
}

}  // namespace passo
