// BoardSession: questions before the hello, the hello itself, and the session's number.
#include <cassert>

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
  greeting_ = greeting.number;
  sent_ = taken_ = executed_ = asked_behind_ = greeting_;
  decoder_.set_motors(motors_);
  progressed_ = heard_ = port_.elapsed();
  phase_ = Phase::greeting;
  say_hello();
}

// Forgets everything of the conversation so far, including an error.
void BoardSession::forget_what_was() {
  board_.reset();
  error_.reset();
  awaited_.reset();
  turned_.reset();
  rehearsed_.reset();
  kept_.clear();
  probe_ = {};
  usual_question_ = last_question_ = Question::status;
  answered_ = true;
  rests_ = repeating_ = outputs_timed_out_ = false;
  refusals_ = doubts_ = free_ = 0;
  pressed_ = 0;
}

void BoardSession::hang_up() {
  forget_what_was();
  sent_ = taken_ = asked_behind_ = executed_;  // nothing is under way any more
  phase_ = Phase::before_hello;
  decoder_.set_motors(max_motors);
}

void BoardSession::say_hello() {
  greeted_ = quiet_since_ = port_.elapsed();
  say(Hello{.motors = motors_}, greeting_);
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
    } else if (board_->motors < motors_) {
      error_ = LinkError::too_few_motors;
    } else if (session_ != 0) {
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
