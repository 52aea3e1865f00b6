// BoardSession: questions before the hello, the hello itself, and the session's number.
#include "passo/base/ensure.hpp"
#include "passo/link/board_session.hpp"

namespace passo {

void BoardSession::inquire(Question question) {
  ensure(question == Question::about || question == Question::status);
  mirror_.forget_about();
  mirror_.forget_status();
  questions_.forget_sent();  // earlier questions no longer count
  await(question);
}

void BoardSession::greet(const Greeting& greeting) {
  ensure(greeting.motors > 0);
  forget_what_was(greeting.number);
  handshake_.begin(greeting);
  twins_.set(greeting.pairs);
  mirror_.begin(greeting.number);
  decoder_.set_motors(greeting.motors);
  sent_segments_.begin(greeting.motors);
  const Seconds now = port_.elapsed();
  silence_.on_frame(now);
  silence_.on_progress(now);
  if (handshake_.is_set_up()) return send_hello();
  // The hello waits for the answer: the board looks at its switches when it is greeted.
  handshake_.record_hello(now);
  silence_.on_asked_again(now);
  say(greeting.setup, std::uint8_t{0});
}

// Forgets everything of the conversation so far, including an error. Frames are counted from `number` on.
void BoardSession::forget_what_was(ItemNumber number) {
  error_.reset();
  window_.begin(number);
  questions_.forget();
  questions_.begin(number);
  handwheel_.forget();
  mirror_.forget_events();
  probe_ = {};
  refusals_ = doubts_ = 0;
}

void BoardSession::hang_up() {
  forget_what_was(executed());  // nothing is under way any more
  handshake_.hang_up();
  decoder_.set_motors(max_motors);
}

// The setup counts for one hello. A board of another version knows no setup, and answers the hello.
void BoardSession::send_hello() {
  const Seconds now = port_.elapsed();
  handshake_.record_hello(now);
  silence_.on_asked_again(now);
  const Greeting& greeting = handshake_.wanted();
  if (greeting.setup != PinSetup{}) say(greeting.setup, std::uint8_t{0});
  say(Hello{.motors = greeting.motors}, greeting.number);
}

void BoardSession::handle(const PinSetup& setup) {
  if (handshake_.phase() != Handshake::Phase::greeting || handshake_.is_set_up()) return;
  if (const auto error = handshake_.handle(setup)) {
    error_ = error;
  } else {
    send_hello();
  }
}

void BoardSession::name_session(std::uint16_t number) {
  ensure(number != 0 && !busy());
  handshake_.rename(number);
  silence_.on_progress(port_.elapsed());
  send_session();
}

void BoardSession::send_session() {
  const Seconds now = port_.elapsed();
  handshake_.record_hello(now);
  silence_.on_asked_again(now);
  say(Session{.number = handshake_.session(), .silence = handshake_.wanted().silence}, std::uint8_t{0});
  ask(Question::status);
}

// Goes on with the greeting if the answer that it waits for has come.
void BoardSession::check_greeting() {
  if (handshake_.phase() == Handshake::Phase::greeting && board()) {
    mirror_.set_room(board()->capacity);
    if (const auto error = handshake_.go_on()) error_ = error;
    if (handshake_.phase() == Handshake::Phase::naming) {
      silence_.on_progress(port_.elapsed());
      mirror_.forget_status();
      send_session();
    }
  }
  if (status()) handshake_.handle(*status());
  news_ = news_ || handshake_.phase() == Handshake::Phase::ready;
}

}  // namespace passo
