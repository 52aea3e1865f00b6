#include "passo/link/board_session.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <span>
#include <utility>

#include "passo/wire/announcement.hpp"

namespace passo {
namespace {

// Because of damage, the board may hear what was never sent, and so may the host. Both are believed only when they come
// again.
constexpr int most_refusals = 8;  // of one frame
constexpr int sure_of_status = 2;

// A peer that talks, and neither answers nor takes nor executes anything, is given up after this many times the
// patience. No item has so long between two of its events.
constexpr double most_patiences = 2;

constexpr std::size_t most_gibberish = 256;

// Limit switches and the emergency stop.
constexpr std::uint16_t stopping_inputs = 0xFF | input_emergency_stop;

}  // namespace

BoardSession::BoardSession(BoardPort& port, const LineCare& care)
    : port_(port), care_(care), heard_(port.elapsed()), quiet_since_(heard_) {
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
    const Seconds patience = std::max(quiet_since_ + care_.answer_within - port_.elapsed(), Seconds(0));
    const Seconds left = std::max(end - port_.elapsed(), Seconds(0));
    const bool heard = hear(std::min(endless ? care_.answer_within : patience, left));
    progress.heard = progress.heard || heard;
    mind_silence(heard, endless);
  } while (!error_ && !news_ && end - port_.elapsed() > hardly_any);
  progress.news = news_;
  return progress;
}

// True: the board has to say something.
bool BoardSession::expects() const {
  return awaited_ || phase_ == Phase::greeting || phase_ == Phase::naming || busy() ||
         (may_lose() && (!kept_.empty() || !answered_));
}

// Silence counts from now on, if nothing was expected before.
void BoardSession::begin_to_expect() {
  if (!expects()) progressed_ = heard_ = quiet_since_ = port_.elapsed();
}

// Asks again, or gives up, after a silence. An endless wait expects something in any case.
void BoardSession::mind_silence(bool heard, bool endless) {
  const Seconds now = port_.elapsed();
  if (error_) return;
  if (heard) quiet_since_ = now;
  if (!endless && !expects()) {
    progressed_ = heard_ = quiet_since_ = now;
  } else if (!may_lose()) {
    if (!heard && endless) error_ = LinkError::no_answer;
  } else if (now - heard_ > care_.patience) {
    error_ = LinkError::no_answer;
  } else if (now - progressed_ > most_patiences * care_.patience) {
    error_ = LinkError::no_progress;
  } else if ((!heard && (endless || care_.answer_within - (now - quiet_since_) <= hardly_any)) || overdue()) {
    quiet_since_ = now;
    ask_again();
  }
}

// True: the board takes too long to take what was sent, or to answer the hello.
bool BoardSession::overdue() const {
  const Seconds now = port_.elapsed();
  if (phase_ == Phase::greeting || phase_ == Phase::naming) return now - greeted_ > care_.answer_within;
  return !kept_.empty() && now - moved_on_ > care_.answer_within;
}

void BoardSession::ask_again() {
  if (phase_ == Phase::greeting) return say_hello();
  if (phase_ == Phase::naming) return say_session();
  ask(awaited_.value_or(Question::status));
}

void BoardSession::send(const BoardSegment& segment) {
  assert(segment.events > 0 && std::abs(segment.change) <= largest_change);
  assert(error_ || room() > 0);
  const BoardSegment for_board = twins_.for_board(segment);
  const bool begins = status_ && !busy() && status_->executed == sent_;
  send_counted(for_board, motors_);
  if (!sent_segments_.keeps()) return;
  if (begins) sent_segments_.stand_at(status_->positions);
  sent_segments_.add(sent_, for_board, port_.elapsed());
}

void BoardSession::send(const BoardOutputs& outputs) {
  assert(error_ || room() > 0);
  outputs_timed_out_ = false;
  send_counted(outputs);
}

ItemNumber BoardSession::replace(ItemNumber after, std::span<const LinkItem> items) {
  assert(!items.empty() && room() >= static_cast<int>(items.size()));
  const auto number = static_cast<ItemNumber>(sent_ + 1);
  Announcement announcement(number, after, motors_);
  frames_.clear();
  for (const LinkItem& item : items) {
    Frame& frame = frames_.emplace_back();
    frame.number = static_cast<ItemNumber>(number + frames_.size());
    const auto sequence = static_cast<std::uint8_t>(frame.number);
    if (const auto* segment = std::get_if<BoardSegment>(&item)) {
      frame.size = encode(twins_.for_board(*segment), motors_, sequence, frame.bytes);
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
  progressed_ = port_.elapsed();
  awaited_ = question;
  ask(question);
}

// An answer to an earlier question may come first. That answer counts if it tells of the same rest.
void BoardSession::watch_probe(ProbeUntil until, std::uint8_t limit) {
  twins_.watch(limit);
  if (!probe_.wish(until, limit)) return;
  status_.reset();
  answered_ = true;  // what went before is over
  await(Question::watch);
}

void BoardSession::recall_contact() {
  await(Question::kept);
}

void BoardSession::read_spindle() {
  turned_.reset();
  answered_ = true;  // what went before is over
  await(Question::spindle);
}

void BoardSession::rehearse(std::size_t bytes) {
  rehearsed_ = port_.elapsed();
  for (const std::uint64_t end = bytes_sent_ + bytes; bytes_sent_ < end && !error_;) {
    say(Session{.number = session_, .silence = silence_}, std::uint8_t{0});
  }
  read_spindle();
}

// Ends the wait, if this is the answer that was awaited.
void BoardSession::settle(Question answered) {
  if (awaited_ != answered) return;
  awaited_.reset();
  news_ = true;
  if (answered == Question::spindle && rehearsed_) answer_time_ = port_.elapsed() - *std::exchange(rehearsed_, {});
}

bool BoardSession::hear(Seconds most) {
  std::span<const std::uint8_t> bytes = port_.replies();
  if (bytes.empty() && port_.run(most)) bytes = port_.replies();
  for (const std::uint8_t byte : bytes) read(byte);
  look_at_greeting();
  return !bytes.empty();
}

void BoardSession::read(std::uint8_t byte) {
  if (phase_ == Phase::before_hello && byte >= ' ' && byte < 127 && gibberish_.size() < most_gibberish) {
    gibberish_ += static_cast<char>(byte);
  }
  if (decoder_.feed(byte) != Decoded::frame) return;
  heard_ = port_.elapsed();
  take(decoder_.frame());
}

// The question goes behind all that was sent.
void BoardSession::ask() {
  question_waits_ = on_wire_ != sent_;
  if (!question_waits_) ask(usual_question_);
}

void BoardSession::ask(Question question) {
  begin_to_expect();
  moved_on_ = port_.elapsed();
  asked_behind_ = on_wire_;
  last_question_ = question;
  if (std::exchange(answered_, false)) unanswered_since_ = moved_on_;
  const std::uint8_t limit = question == Question::watch ? probe_.limit() : std::uint8_t{0};
  const std::uint8_t motors = phase_ == Phase::before_hello ? std::uint8_t{max_motors} : motors_;
  say(Ask{.motors = motors, .question = question, .limit = limit}, ++question_);
}

void BoardSession::take(const WireFrame& frame) {
  switch (frame.type) {
    case MessageType::hello_reply:
      if (phase_ == Phase::greeting) decode(frame, board_.emplace());
      return;
    case MessageType::credit: {
      Credit credit;
      decode(frame, credit);
      if (phase_ == Phase::before_hello || !board_) return;
      take(credit);
      // The board seems to have dropped what was sent. Ask to be sure.
      if (may_lose() && holds_nothing_of(credit) && executed_ != sent_) ask(Question::status);
      return;
    }
    case MessageType::status: {
      BoardStatus status;
      decode(frame, phase_ == Phase::before_hello ? std::uint8_t{max_motors} : motors_, status);
      if (awaited_ == Question::watch && probe_.is_confirmed_by(status, executed_)) twins_.settle(status.positions);
      if (phase_ != Phase::before_hello) twins_.for_host(status.positions);
      return take(status);
    }
    case MessageType::error: {
      ErrorReport error;
      decode(frame, error);
      return take(error);
    }
    case MessageType::fault: {
      Fault fault;
      decode(frame, fault);
      return take(fault);
    }
    case MessageType::pin_setup: {
      PinSetup setup;
      decode(frame, setup);
      return take(setup);
    }
    case MessageType::captured: {
      Captured captured;
      decode(frame, phase_ == Phase::before_hello ? std::uint8_t{max_motors} : motors_, captured);
      if (phase_ != Phase::before_hello) twins_.for_host(captured.positions);
      return take(captured);
    }
    case MessageType::turned: {
      Turned turned;
      decode(frame, turned);
      return take(turned);
    }
    case MessageType::about: decode(frame, about_.emplace()); return settle(Question::about);
    default:
      if (!may_lose()) error_ = LinkError::refused;
      return;
  }
}

// A board that does not know yet how its switches are wired may take them for closed.
void BoardSession::take(const Fault& fault) {
  if (phase_ == Phase::before_hello || !is_set_up()) return;
  stopped_by_ = fault.inputs;
  inputs_ |= fault.inputs;
  error_ = LinkError::stopped;
}

// Ignores a credit that a later credit has overtaken, and a credit that is impossible.
void BoardSession::take(const Credit& credit) {
  const int more = later_by(credit.executed, executed_);
  const auto more_taken = static_cast<std::uint8_t>(credit.taken - static_cast<std::uint8_t>(taken_));
  const auto taken = static_cast<ItemNumber>(taken_ + more_taken);
  if (more < 0 || later_by(taken, sent_) > 0 || later_by(credit.executed, taken) > 0) return;
  if (credit.free > board_->capacity) return;
  const ItemNumber before = taken_;
  note_taken(credit.taken);
  if (more == 0 && taken_ == before && credit.free <= free_) return;
  if (more != 0) progressed_ = port_.elapsed();
  executed_ = credit.executed;
  free_ = credit.free;
  news_ = true;
}

bool BoardSession::holds_nothing_of(const Credit& credit) const {
  return taken_ == sent_ && credit.taken == static_cast<std::uint8_t>(sent_) && credit.free == board_->capacity;
}

void BoardSession::take(const BoardStatus& status) {
  if (status_ && status.event != status_->event) progressed_ = port_.elapsed();
  status_ = status;
  status_time_ = port_.elapsed();
  if (phase_ == Phase::before_hello) {
    inputs_ = status.inputs;
    return settle(Question::status);
  }
  if ((status.state & board_manual) != 0) {
    error_ = LinkError::manual;
    return;
  }
  const bool is_asked_for_more = last_question_ == Question::spindle && status.answers == question_;
  if (is_asked_for_more && (status.state & board_encodes) == 0) return doubt(LinkError::no_encoder, Question::spindle);
  note_inputs(status);
  if (usual_question_ == Question::status) note_answer(status.taken);
  note_probe(probe_.note(status));
  if (awaited_ == Question::watch && probe_.is_confirmed_by(status, executed_)) {
    probe_.confirm(status);
    settle(Question::watch);
  }
  const bool is_known = session_ != 0 && status.session == session_;
  // Before the board has heard of the session it is no wonder.
  if (!is_known && session_ != 0 && phase_ == Phase::ready) return doubt(LinkError::was_reset);
  const bool slipped = is_known && (status.state & board_slipped) != 0;
  if (slipped && !standstill_ && !note_standstill(status)) return;
  if (is_known && (status.state & board_trusted) == 0) {
    if ((status.inputs & drivers_timed_out) != 0) return doubt(LinkError::drivers_off);
    // A board that has stood still is not trusted either, and goes on. One that stops forgets that it stood still.
    if (!slipped) {
      stopped_by_ = inputs_ & stopping_inputs;
      return doubt(LinkError::stopped);
    }
  }
  // What is in doubt answers nothing: the counts of a board that was reset are not those of the motors.
  if (status.answers == question_) settle(Question::status);
  if (!is_known) return;
  doubts_ = 0;
  note_timeout(status);
  const Credit credit{.executed = status.executed, .taken = status.taken, .free = status.free};
  note_progress(credit, status.answers);
  rests_ = holds_nothing_of(credit) && (status.state & (board_moves | board_replaces)) == 0;
  news_ = news_ || rests_;
}

void BoardSession::note_progress(const Credit& credit, std::uint8_t answers) {
  take(credit);
  if (answers != question_ && !(repeating_ && answers == repeated_before_)) return;
  // A frame that was sent before the question and has not arrived before it is lost.
  repeating_ = false;
  if (later_by(asked_behind_, taken_) > 0) return repeat();
  put_frames_on_wire();
  // The answer that tells where the spindle is was lost, or the question was.
  if (!answered_ && usual_question_ == Question::spindle) ask();
}

void BoardSession::take(const Turned& turned) {
  if (phase_ == Phase::before_hello) return;
  turned_ = turned;
  note_answer(turned.progress.taken);
  note_progress(turned.progress, turned.answers);
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
bool BoardSession::note_standstill(const BoardStatus& status) {
  if (++doubts_ < sure_of_status) {
    ask(Question::status);
    return false;
  }
  standstill_ = status;
  news_ = true;
  return true;
}

void BoardSession::take(const Captured& captured) {
  if ((captured.input & captured_kept) != 0) {
    if (awaited_ == Question::kept) probe_.recall(captured, motors_);
    return settle(Question::kept);
  }
  const auto pressed =
      static_cast<std::uint16_t>(captured.input & ~(probe_.input() | captured_kept | captured_released));
  pressed_ |= pressed;
  inputs_ |= pressed;
  news_ = news_ || pressed != 0;
  note_probe(probe_.note(captured));
}

void BoardSession::note_inputs(const BoardStatus& status) {
  const auto inputs = static_cast<std::uint16_t>(status.inputs & ~(passo::outputs_timed_out | drivers_timed_out));
  const auto pressed = static_cast<std::uint16_t>(inputs & ~inputs_ & ~unsigned{probe_.input()});
  pressed_ |= pressed;
  news_ = news_ || pressed != 0;
  inputs_ = inputs;
}

// A status from before the last outputs says nothing of now.
void BoardSession::note_timeout(const BoardStatus& status) {
  if (status.taken != static_cast<std::uint8_t>(sent_)) return;
  outputs_timed_out_ = (status.inputs & passo::outputs_timed_out) != 0;
}

void BoardSession::note_probe(ProbeWatch::News news) {
  if (news == ProbeWatch::News::happened) {
    news_ = true;
    sent_segments_.stop(port_.elapsed());
  }
  if (news == ProbeWatch::News::begin_again) ask(Question::watch);
}

void BoardSession::note_answer(std::uint8_t taken) {
  if (answered_ || static_cast<std::uint8_t>(sent_) != taken) return;
  answered_ = news_ = true;
  // What was sent must be done, too, and what was asked answered.
  if (!busy() && !awaited_) progressed_ = port_.elapsed();
  answer_time_ = port_.elapsed() - unanswered_since_;
}

void BoardSession::take(const ErrorReport& error) {
  if (phase_ == Phase::before_hello || error_) return;
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
      if (error.reason == WireError::bad_value && awaited_ == Question::watch && probe_.watches_several()) {
        error_ = LinkError::cannot_watch;
        return;
      }
      break;
  }
  if (!may_lose()) error_ = LinkError::refused;
  note_taken(static_cast<std::uint8_t>(error.expected - 1));
  // A complaint during a repetition is about older frames. If it is not, the answer to the question after the
  // repetition tells.
  if (!repeating_) repeat();
}

template <class Message, class... More>
void BoardSession::send_counted(const Message& message, More... more) {
  if (error_) return;
  Frame frame{.number = static_cast<ItemNumber>(sent_ + 1)};
  frame.size = encode(message, more..., static_cast<std::uint8_t>(frame.number), frame.bytes);
  send_frame(frame);
}

}  // namespace passo
