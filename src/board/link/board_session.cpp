#include "passo/link/board_session.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>
#include <utility>

#include "passo/base/ensure.hpp"
#include "passo/wire/announcement.hpp"

namespace passo {
namespace {

// Because of damage, the board may hear what was never sent, and so may the host. Both are believed only when they come
// again.
constexpr int most_refusals = 8;  // of one frame
constexpr int sure_of_status = 2;

constexpr std::size_t most_gibberish = 256;

// In bytes, of the frames on the wire that a small board has not taken. It keeps 256 received bytes; the rest is for
// questions. A board with many places takes frames as fast as they come.
constexpr std::size_t most_under_way_to_small = 224;
constexpr int many_places = 200;

// What a step generator hands on, and no board refuses.
bool is_playable(const BoardSegment& segment) {
  return segment.events > 0 && segment.events <= most_events && std::abs(segment.change) <= largest_change;
}

}  // namespace

BoardSession::BoardSession(BoardPort& port, const LinkTimeouts& care)
    : port_(port), silence_(care, port.elapsed()), window_(port, silence_.may_lose()) {
  decoder_.set_motors(max_motors);
}

BoardSession::Progress BoardSession::poll(Seconds most) {
  const bool endless = std::isinf(most.value());
  const Seconds end = port_.elapsed() + most;
  Progress progress;
  news_ = false;
  if (error_) {  // nothing is expected any more, but time still passes
    progress.heard = hear(endless ? Seconds(0) : most);
    return progress;
  }
  do {
    const Seconds patience = silence_.until_question(port_.elapsed());
    const Seconds left = std::max(end - port_.elapsed(), Seconds(0));
    const bool heard = hear(std::min(endless ? silence_.care().answer_within : patience, left));
    progress.heard = progress.heard || heard;
    check_silence(heard, endless);
  } while (!error_ && !news_ && end - port_.elapsed() > hardly_any);
  progress.news = news_;
  return progress;
}

// True: the board has to say something.
bool BoardSession::expects() const {
  return questions_.awaited() || handshake_.is_under_way() || busy() ||
         (silence_.may_lose() && (window_.keeps_any() || !questions_.answered()));
}

// Silence counts from now on, if nothing was expected before.
void BoardSession::begin_to_expect() {
  if (!expects()) silence_.begin(port_.elapsed());
}

// Asks again, or gives up, after a silence. An endless wait expects something in any case.
void BoardSession::check_silence(bool heard, bool endless) {
  if (error_) return;
  const Seconds now = port_.elapsed();
  if (heard) silence_.on_byte(now);
  if (!endless && !expects()) return silence_.begin(now);
  error_ = silence_.verdict(now, endless && !heard);
  if (error_ || (!silence_.is_to_ask_again(now, heard, endless) && !overdue())) return;
  silence_.on_asked_again(now);
  ask_again();
}

// True: the board takes too long to take what was sent, or to answer the hello.
bool BoardSession::overdue() const {
  if (handshake_.is_under_way()) return silence_.is_overdue(handshake_.said(), now());
  return window_.keeps_any() && silence_.is_overdue(silence_.traffic(), now());
}

void BoardSession::ask_again() {
  if (handshake_.phase() == Handshake::Phase::greeting) return send_hello();
  if (handshake_.phase() == Handshake::Phase::naming) return send_session();
  ask(questions_.awaited().value_or(Question::status));
}

void BoardSession::send(const BoardSegment& segment) {
  ensure(is_playable(segment));
  ensure(error_ || room() > 0);
  const BoardSegment for_board = twins_.for_board(segment);
  const bool begins = status() && !busy() && status()->executed == sent();
  send_counted(for_board, motors());
  if (!sent_segments_.keeps()) return;
  if (begins) sent_segments_.stand_at(status()->positions);
  sent_segments_.add(sent(), for_board, port_.elapsed());
}

void BoardSession::send(const BoardOutputs& outputs) {
  ensure(error_ || room() > 0);
  mirror_.end_timeout();
  send_counted(outputs);
}

ItemNumber BoardSession::replace(ItemNumber after, std::span<const LinkItem> items) {
  ensure(error_ || (!items.empty() && room() >= static_cast<int>(items.size())));
  const ItemNumber number = window_.next();
  Announcement announcement(number, after, motors());
  frames_.clear();
  for (const LinkItem& item : items) {
    SendWindow::Frame& frame = frames_.emplace_back();
    frame.number = static_cast<ItemNumber>(number + frames_.size());
    const auto sequence = static_cast<std::uint8_t>(frame.number);
    if (const auto* segment = std::get_if<BoardSegment>(&item)) {
      ensure(is_playable(*segment));
      frame.size = encode(twins_.for_board(*segment), motors(), sequence, frame.bytes);
    } else {
      frame.size = encode(std::get<BoardOutputs>(item), sequence, frame.bytes);
    }
    announcement.add(frame.bytes, frame.size);
  }
  send_counted(announcement.replace());
  sent_segments_.drop_behind(after);
  for (std::size_t i = 0; i < items.size(); ++i) {
    send_frame(frames_[i]);
    const auto* const segment = std::get_if<BoardSegment>(&items[i]);
    if (segment != nullptr) sent_segments_.add(frames_[i].number, twins_.for_board(*segment), port_.elapsed());
  }
  return static_cast<ItemNumber>(number + 1);
}

void BoardSession::await(Question question) {
  begin_to_expect();
  silence_.on_progress(port_.elapsed());
  questions_.await(question);
  ask(question);
}

// An answer to an earlier question may come first. That answer counts if it tells of the same rest.
void BoardSession::watch_probe(ProbeUntil until, std::uint8_t limit) {
  twins_.watch(limit);
  if (!probe_.wish(until, limit)) return;
  mirror_.forget_status();
  questions_.forget_sent();  // what went before is over
  await(Question::watch);
}

void BoardSession::recall_contact() {
  await(Question::kept);
}

void BoardSession::read_spindle() {
  static_cast<void>(questions_.take_turned());
  questions_.forget_sent();  // what went before is over
  await(Question::spindle);
}

void BoardSession::rehearse(std::size_t bytes) {
  questions_.begin_rehearsal(port_.elapsed());
  for (const std::uint64_t end = bytes_sent() + bytes; bytes_sent() < end && !error_;) {
    say(Session{.number = handshake_.session(), .silence = handshake_.wanted().silence}, std::uint8_t{0});
  }
  read_spindle();
}

// Ends the wait, if this is the answer that was awaited.
void BoardSession::settle(Question answered) {
  if (questions_.settle(answered, port_.elapsed())) news_ = true;
}

bool BoardSession::hear(Seconds most) {
  std::span<const std::uint8_t> bytes = port_.replies();
  if (bytes.empty() && port_.run(most)) bytes = port_.replies();
  for (const std::uint8_t byte : bytes) read(byte);
  check_greeting();
  return !bytes.empty();
}

void BoardSession::read(std::uint8_t byte) {
  if (handshake_.before_hello() && byte >= ' ' && byte < 127 && gibberish_.size() < most_gibberish) {
    gibberish_ += static_cast<char>(byte);
  }
  if (decoder_.feed(byte) != Decoded::frame) return;
  silence_.on_frame(port_.elapsed());
  handle(decoder_.frame());
}

// The question goes behind all that was sent.
void BoardSession::ask() {
  questions_.hold_back(window_.waits());
  if (!window_.waits()) ask(questions_.usual());
}

void BoardSession::ask(Question question) {
  begin_to_expect();
  const Seconds now = port_.elapsed();
  silence_.on_traffic(now);
  const std::uint8_t number = questions_.put(question, window_.on_wire(), now);
  const std::uint8_t limit = question == Question::watch ? probe_.limit() : std::uint8_t{0};
  say(Ask{.motors = handshake_.positions(), .question = question, .limit = limit}, number);
}

void BoardSession::ask_for_handwheel() {
  if (!ready() || awaits_handwheel()) return;
  const std::uint8_t number = handwheel_.put(questions_.number(), now());
  say(Ask{.motors = handshake_.positions(), .question = Question::handwheel}, number);
}

void BoardSession::handle(const WireFrame& frame) {
  switch (frame.type) {
    case MessageType::hello_reply: {
      HelloReply reply;
      decode(frame, reply);
      return handshake_.handle(reply);
    }
    case MessageType::credit: {
      Credit credit;
      decode(frame, credit);
      if (handshake_.before_hello() || !board()) return;
      handle(credit);
      // The board seems to have dropped what was sent. Ask to be sure.
      if (silence_.may_lose() && holds_nothing_of(credit) && busy()) ask(Question::status);
      return;
    }
    case MessageType::status: {
      BoardStatus status;
      decode(frame, handshake_.positions(), status);
      if (questions_.awaited() == Question::watch && probe_.is_confirmed_by(status, executed())) {
        twins_.settle(status.positions);
      }
      if (!handshake_.before_hello()) twins_.for_host(status.positions);
      return handle(status);
    }
    case MessageType::error: {
      ErrorReport error;
      decode(frame, error);
      return handle(error);
    }
    case MessageType::fault: {
      Fault fault;
      decode(frame, fault);
      return handle(fault);
    }
    case MessageType::pin_setup: {
      PinSetup setup;
      decode(frame, setup);
      return handle(setup);
    }
    case MessageType::captured: {
      Captured captured;
      decode(frame, handshake_.positions(), captured);
      if (!handshake_.before_hello()) twins_.for_host(captured.positions);
      return handle(captured);
    }
    case MessageType::turned: {
      Turned turned;
      decode(frame, turned);
      return handle(turned);
    }
    case MessageType::about: {
      About about;
      decode(frame, about);
      mirror_.update(about);
      return settle(Question::about);
    }
    default:
      if (!silence_.may_lose()) error_ = LinkError::refused;
      return;
  }
}

// A board that does not know yet how its switches are wired may take them for closed.
void BoardSession::handle(const Fault& fault) {
  if (handshake_.before_hello() || !handshake_.is_set_up()) return;
  mirror_.record_stop(fault.inputs);
  error_ = LinkError::stopped;
}

// Ignores a credit that a later credit has overtaken, and a credit that is impossible.
void BoardSession::handle(const Credit& credit) {
  const int more = later_by(credit.executed, executed());
  const ItemNumber before = window_.taken();
  const auto more_taken = static_cast<std::uint8_t>(credit.taken - static_cast<std::uint8_t>(before));
  const auto taken = static_cast<ItemNumber>(before + more_taken);
  if (more < 0 || later_by(taken, sent()) > 0 || later_by(credit.executed, taken) > 0) return;
  if (!board() || credit.free > board()->capacity) return;
  on_accepted(credit.taken);
  if (more == 0 && window_.taken() == before && credit.free <= mirror_.free()) return;
  if (more != 0) silence_.on_progress(port_.elapsed());
  mirror_.update_items(credit.executed, credit.free);
  news_ = true;
}

bool BoardSession::holds_nothing_of(const Credit& credit) const {
  return board() && credit.free == board()->capacity && window_.untaken() == 0 &&
         credit.taken == static_cast<std::uint8_t>(sent());
}

void BoardSession::handle(const BoardStatus& status) {
  if (mirror_.update(status, port_.elapsed())) silence_.on_progress(port_.elapsed());
  if (handshake_.before_hello()) {
    mirror_.set_inputs(status.inputs);
    return settle(Question::status);
  }
  if ((status.state & board_manual) != 0) {
    error_ = LinkError::manual;
    return;
  }
  handwheel_.record_status(status.answers);
  const bool is_asked_for_more = questions_.last() == Question::spindle && status.answers == questions_.number();
  if (is_asked_for_more && (status.state & board_encodes) == 0) return doubt(LinkError::no_encoder, Question::spindle);
  if (mirror_.update_inputs(status, probe_.input())) news_ = true;
  if (questions_.usual() == Question::status) on_answer(status.taken);
  on_probe_news(probe_.handle(status));
  if (questions_.awaited() == Question::watch && probe_.is_confirmed_by(status, executed())) {
    probe_.confirm(status);
    settle(Question::watch);
  }
  const bool has_session = handshake_.session() != 0;
  const bool is_known = has_session && status.session == handshake_.session();
  // Before the board has heard of the session it is no wonder.
  if (!is_known && has_session && handshake_.phase() == Handshake::Phase::ready) return doubt(LinkError::was_reset);
  const bool slipped = is_known && (status.state & board_slipped) != 0;
  if (slipped && !standstill() && !on_standstill(status)) return;
  if (is_known && (status.state & board_trusted) == 0) {
    if ((status.inputs & drivers_timed_out) != 0) return doubt(LinkError::drivers_off);
    // A board that has stood still is not trusted either, and goes on. One that stops forgets that it stood still.
    if (!slipped) {
      mirror_.record_stop();
      return doubt(LinkError::stopped);
    }
  }
  // What is in doubt answers nothing: the counts of a board that was reset are not those of the motors.
  if (status.answers == questions_.number()) settle(Question::status);
  if (!is_known) return;
  doubts_ = 0;
  mirror_.on_timeout(status, sent());
  const Credit credit{.executed = status.executed, .taken = status.taken, .free = status.free};
  on_progress(credit, status.answers);
  mirror_.record_rest(holds_nothing_of(credit) && (status.state & (board_moves | board_replaces)) == 0);
  news_ = news_ || rests();
}

void BoardSession::on_progress(const Credit& credit, std::uint8_t answers) {
  handle(credit);
  if (answers != questions_.number() && !window_.awaits_answer(answers)) return;
  // A frame that was sent before the question and has not arrived before it is lost.
  window_.go_on();
  if (later_by(questions_.behind(), window_.taken()) > 0) return repeat();
  put_frames_on_wire();
  // The answer that tells where the spindle is was lost, or the question was.
  if (!answered() && questions_.usual() == Question::spindle) ask();
}

void BoardSession::handle(const Turned& turned) {
  if (handshake_.before_hello()) return;
  if (handwheel_.record(turned)) {
    news_ = true;
    return;
  }
  questions_.record_turned(turned);
  on_answer(turned.progress.taken);
  on_progress(turned.progress, turned.answers);
  settle(Question::spindle);
}

void BoardSession::doubt(LinkError error, Question again) {
  if (++doubts_ == sure_of_status) {
    error_ = error;
  } else {
    ask(again);
  }
}

// False: not sure yet.
bool BoardSession::on_standstill(const BoardStatus& status) {
  if (++doubts_ < sure_of_status) {
    ask(Question::status);
    return false;
  }
  mirror_.on_standstill(status);
  news_ = true;
  return true;
}

void BoardSession::handle(const Captured& captured) {
  if ((captured.input & captured_kept) != 0) {
    if (questions_.awaited() == Question::kept) probe_.recall(captured, motors());
    return settle(Question::kept);
  }
  const auto pressed =
      static_cast<std::uint16_t>(captured.input & ~(probe_.input() | captured_kept | captured_released));
  if (mirror_.record_pressed(pressed)) news_ = true;
  on_probe_news(probe_.handle(captured));
}

void BoardSession::on_probe_news(ProbeWatch::News news) {
  if (news == ProbeWatch::News::happened) {
    news_ = true;
    sent_segments_.stop(port_.elapsed());
  }
  if (news == ProbeWatch::News::begin_again) ask(Question::watch);
}

void BoardSession::on_answer(std::uint8_t taken) {
  if (static_cast<std::uint8_t>(sent()) != taken || !questions_.on_answered(port_.elapsed())) return;
  news_ = true;
  // What was sent must be done, too, and what was asked answered.
  if (!busy() && !questions_.awaited()) silence_.on_progress(port_.elapsed());
}

void BoardSession::handle(const ErrorReport& error) {
  if (handshake_.before_hello() || error_) return;
  switch (error.reason) {
    case WireError::bad_frame:
    case WireError::out_of_sequence:
    case WireError::queue_full: break;
    case WireError::too_late:
    case WireError::silent_host:
    case WireError::wrong_sums: return;  // the executed items will tell
    case WireError::manual: error_ = LinkError::manual; return;
    default:
      // The board may complain of what was sent, or of damage that it heard instead.
      refusals_ = error.expected == refused_ ? refusals_ + 1 : 1;
      refused_ = error.expected;
      if (refusals_ == most_refusals) error_ = LinkError::refused;
      if (error.reason == WireError::bad_value && questions_.awaited() == Question::watch && probe_.watches_several()) {
        error_ = LinkError::cannot_watch;
        return;
      }
      break;
  }
  if (!silence_.may_lose()) error_ = LinkError::refused;
  on_accepted(static_cast<std::uint8_t>(error.expected - 1));
  // A complaint during a repetition is about older frames. If it is not, the answer to the question after the
  // repetition tells.
  if (!window_.awaits_answer()) repeat();
}

template <class Message, class... More>
void BoardSession::send_counted(const Message& message, More... more) {
  if (error_) return;
  SendWindow::Frame frame{.number = window_.next()};
  frame.size = encode(message, more..., static_cast<std::uint8_t>(frame.number), frame.bytes);
  send_frame(frame);
}

// Sends the next frame that is counted.
void BoardSession::send_frame(const SendWindow::Frame& frame) {
  if (error_) return;
  begin_to_expect();
  mirror_.record_rest(false);
  const Seconds now = port_.elapsed();
  questions_.record_sent(now);
  silence_.on_traffic(now);
  window_.push(frame);
  put_frames_on_wire();
}

void BoardSession::put_frames_on_wire() {
  if (error_ || !window_.fill(most_under_way())) return;
  if (questions_.release()) ask(questions_.usual());
}

std::size_t BoardSession::most_under_way() const {
  const bool is_small = board() && board()->capacity < many_places;
  return is_small ? most_under_way_to_small : SendWindow::no_limit;
}

void BoardSession::on_accepted(std::uint8_t sequence) {
  if (!window_.on_accepted(sequence)) return;
  silence_.on_progress(port_.elapsed());
  silence_.on_traffic(port_.elapsed());
  news_ = true;
  put_frames_on_wire();
}

// A question after the repeated frames tells whether they have arrived. Nothing else is sent meanwhile.
void BoardSession::repeat() {
  if (error_ || !window_.keeps_any()) return;
  window_.repeat(most_under_way());
  if (!window_.waits()) questions_.hold_back(false);
  ask(questions_.usual());
  // Without a session no answer tells the progress.
  if (handshake_.session() != 0) window_.await_answer(questions_.number());
}

}  // namespace passo
