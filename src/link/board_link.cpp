#include "passo/link/board_link.hpp"

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <span>
#include <utility>

#include "passo/wire/announcement.hpp"

namespace passo {
namespace {

// Frames that are sent again before the board is asked what it has of them.
constexpr std::size_t repeated_at_once = 16;

// The board may hear what was never sent, and so may we: both are believed when they come again.
constexpr int most_refusals = 8;  // of one frame
constexpr int sure_of_status = 2;

constexpr ProbeUntil until_is(bool touched) {
  return touched ? ProbeUntil::touched : ProbeUntil::released;
}

}  // namespace

BoardLink::BoardLink(BoardPort& port, std::uint8_t motors, const LineCare& care)
    : port_(port),
      motors_(motors),
      care_(care),
      sent_(care.greeting),
      taken_(care.greeting),
      executed_(care.greeting),
      asked_behind_(care.greeting),
      heard_(port.elapsed()) {
  decoder_.set_motors(motors);
  say_hello();
  if (care_.session != 0 && !error_) name_session();
}

void BoardLink::say_hello() {
  while (!board_ && !error_) {
    say(Hello{.motors = motors_}, care_.greeting);
    const bool heard = hear_until([this] { return board_.has_value(); });
    if (!heard && (!may_lose() || port_.elapsed() - heard_ > care_.patience)) error_ = LinkError::no_answer;
  }
  if (error_) return;
  free_ = board_->capacity;
  if (board_->version != protocol_version) {
    error_ = LinkError::wrong_version;
  } else if (board_->motors < motors_) {
    error_ = LinkError::too_few_motors;
  }
}

void BoardLink::name_session() {
  const auto named = [this] { return status_ && status_->session == care_.session; };
  while (!error_ && !named()) {
    say(Session{.number = care_.session}, std::uint8_t{0});
    ask();
    if (!hear_until(named) && (!may_lose() || port_.elapsed() - heard_ > care_.patience)) error_ = LinkError::no_answer;
  }
}

void BoardLink::send(const BoardSegment& segment) {
  assert(segment.events > 0 && std::abs(segment.change) <= largest_change);
  wait_for_room();
  send_counted(segment, motors_);
}

void BoardLink::send(const BoardOutputs& outputs) {
  wait_for_room();
  send_counted(outputs);
}

ItemNumber BoardLink::replace(ItemNumber after, std::span<const LinkItem> items) {
  assert(!items.empty() && room() >= static_cast<int>(items.size()));
  const auto number = static_cast<ItemNumber>(sent_ + 1);
  Announcement announcement(number, after, motors_);
  frames_.clear();
  for (const LinkItem& item : items) {
    Frame& frame = frames_.emplace_back();
    frame.number = static_cast<ItemNumber>(number + frames_.size());
    const auto sequence = static_cast<std::uint8_t>(frame.number);
    if (const auto* segment = std::get_if<BoardSegment>(&item)) {
      frame.size = encode(*segment, motors_, sequence, frame.bytes);
    } else {
      frame.size = encode(std::get<BoardOutputs>(item), sequence, frame.bytes);
    }
    announcement.add(frame.bytes, frame.size);
  }
  send_counted(announcement.replace());
  for (const Frame& frame : frames_) send_frame(frame);
  return static_cast<ItemNumber>(number + 1);
}

void BoardLink::drain() {
  while (!error_ && busy() && listen()) {
  }
}

void BoardLink::wait() {
  news_ = false;
  while (!error_ && !news_ && listen()) {
  }
}

void BoardLink::let_pass(Seconds time) {
  constexpr Seconds hardly_any{1e-6};  // less than a tick may be none
  const Seconds until = port_.elapsed() + time;
  while (!error_ && until - port_.elapsed() > hardly_any) hear(until - port_.elapsed());
}

// An answer to an earlier question may come first: it counts if it tells of the same rest.
void BoardLink::watch_probe(ProbeUntil until, std::uint8_t limit) {
  const bool homed = std::exchange(limit_, limit) != 0;
  probe_until_ = ProbeUntil::off;
  probe_report_ = {};
  // A limit switch that is watched no longer stops the motors again: that must be certain.
  if (until == ProbeUntil::off && !homed) return;
  const auto rests = [this] {
    return status_ && status_->executed == executed_ && (status_->state & (board_moves | board_kept)) == 0 &&
           ((status_->state & board_homes) != 0) == (limit_ != 0);
  };
  status_.reset();
  answered_ = true;  // what went before is over
  ask(Question::watch);
  while (!rests() && listen([this] { ask(Question::watch); })) {
  }
  probe_report_ = {};
  if (error_ || until == ProbeUntil::off) return;
  probe_until_ = until;
  probe_report_.touched = (status_->inputs & watched()) != 0;
  began_as_wanted_ = until == until_is(probe_report_.touched);
  std::copy_n(status_->positions, probed_from_.size(), probed_from_.begin());
}

void BoardLink::recall_contact() {
  recalled_.reset();
  ask(Question::kept);
  while (!recalled_ && listen([this] { ask(Question::kept); })) {
  }
  if (!recalled_) return;
  const bool touched = (recalled_->input & captured_released) == 0;
  probe_report_.happened = (recalled_->input & watched()) != 0 && probe_until_ == until_is(touched);
  if (!probe_report_.happened) return;
  for (std::size_t m = 0; m < motors_; ++m) probe_report_.steps[m] = recalled_->positions[m] - probed_from_[m];
}

void BoardLink::wait_for_room() {
  while (!error_ && room() <= 0 && listen()) {
  }
}

// Waits for what the board has to say, for as long as it may take; after a silence asks again. False when it is no use
// to wait any longer.
template <class Again>
bool BoardLink::listen(Again again) {
  const bool heard = hear();
  if (error_) return false;
  if (!may_lose()) {
    if (!heard) error_ = LinkError::no_answer;
  } else if (port_.elapsed() - heard_ > care_.patience) {
    error_ = LinkError::no_answer;
  } else if (!heard || overdue()) {
    again();
  }
  return !error_;
}

bool BoardLink::listen() {
  return listen([this] { ask(Question::status); });
}

// An answer comes in pieces, on a slow line byte by byte: what was asked is asked again only when its time is over.
template <class Done>
bool BoardLink::hear_until(Done done) {
  const Seconds asked = port_.elapsed();
  bool heard = false;
  while (!error_ && !done() && port_.elapsed() - asked <= care_.answer_within && hear(care_.answer_within))
    heard = true;
  return heard;
}

void BoardLink::listen_for(Seconds most) {
  const Seconds end = port_.elapsed() + most;
  ask(Question::status);
  while (!error_ && pressed_ == 0 && port_.elapsed() < end && hear(end - port_.elapsed())) {
  }
}

bool BoardLink::hear() {
  return hear(care_.answer_within);
}

bool BoardLink::hear(Seconds most) {
  std::span<const std::uint8_t> bytes = port_.replies();
  if (bytes.empty() && port_.run(most)) bytes = port_.replies();
  for (const std::uint8_t byte : bytes) {
    if (decoder_.feed(byte) != Decoded::frame) continue;
    heard_ = port_.elapsed();
    take(decoder_.frame());
  }
  return !bytes.empty();
}

// It takes too long until the board has what was sent.
bool BoardLink::overdue() const {
  return !kept_.empty() && port_.elapsed() - moved_on_ > care_.answer_within;
}

void BoardLink::ask(Question question) {
  moved_on_ = port_.elapsed();
  asked_behind_ = sent_;
  last_question_ = question;
  if (std::exchange(answered_, false)) unanswered_since_ = moved_on_;
  const std::uint8_t limit = question == Question::watch ? limit_ : std::uint8_t{0};
  say(Ask{.motors = motors_, .question = question, .limit = limit}, ++question_);
}

void BoardLink::take(const WireFrame& frame) {
  switch (frame.type) {
    case MessageType::hello_reply: return decode(frame, board_.emplace());
    case MessageType::credit: {
      Credit credit;
      decode(frame, credit);
      take(credit);
      // It has dropped what was sent. Is that so?
      if (may_lose() && holds_nothing_of(credit) && executed_ != sent_) ask(Question::status);
      return;
    }
    case MessageType::status: {
      BoardStatus status;
      decode(frame, motors_, status);
      return take(status);
    }
    case MessageType::error: {
      ErrorReport error;
      decode(frame, error);
      return take(error);
    }
    case MessageType::fault: error_ = LinkError::stopped; break;
    case MessageType::captured: {
      Captured captured;
      decode(frame, motors_, captured);
      return take(captured);
    }
    case MessageType::turned: {
      Turned turned;
      decode(frame, turned);
      return take(turned);
    }
    case MessageType::about: break;
    default:
      if (!may_lose()) error_ = LinkError::refused;
      break;
  }
}

// One that was overtaken by a later one tells nothing, and neither does one that cannot be.
void BoardLink::take(const Credit& credit) {
  const int more = later_by(credit.executed, executed_);
  const auto more_taken = static_cast<std::uint8_t>(credit.taken - static_cast<std::uint8_t>(taken_));
  const auto taken = static_cast<ItemNumber>(taken_ + more_taken);
  if (more < 0 || later_by(taken, sent_) > 0 || later_by(credit.executed, taken) > 0) return;
  if (credit.free > board_->capacity) return;
  const ItemNumber before = taken_;
  note_taken(credit.taken);
  if (more == 0 && taken_ == before && credit.free <= free_) return;
  executed_ = credit.executed;
  free_ = credit.free;
  news_ = true;
}

bool BoardLink::holds_nothing_of(const Credit& credit) const {
  return taken_ == sent_ && credit.taken == static_cast<std::uint8_t>(sent_) && credit.free == board_->capacity;
}

void BoardLink::take(const BoardStatus& status) {
  status_ = status;
  if ((status.state & board_manual) != 0) {
    error_ = LinkError::manual;
    return;
  }
  const bool is_asked_for_more = last_question_ == Question::spindle && status.answers == question_;
  if (is_asked_for_more && (status.state & board_encodes) == 0) return doubt(LinkError::no_encoder, Question::spindle);
  note_inputs(status);
  note_probe(status);
  if (care_.session == 0 || status.session != care_.session) {
    // Before the board has heard of the session it is no wonder.
    if (care_.session != 0 && sent_ != care_.greeting) doubt(LinkError::was_reset);
    return;
  }
  if ((status.state & board_trusted) == 0) return doubt(LinkError::stopped);
  doubts_ = 0;
  const Credit credit{.executed = status.executed, .taken = status.taken, .free = status.free};
  note_progress(credit, status.answers);
  rests_ = holds_nothing_of(credit) && (status.state & (board_moves | board_replaces)) == 0;
  news_ = news_ || rests_;
}

void BoardLink::note_progress(const Credit& credit, std::uint8_t answers) {
  take(credit);
  if (answers != question_ && !(repeating_ && answers == repeated_before_)) return;
  // What was sent before the question, and has not arrived before it, is lost.
  if (std::exchange(repeating_, false) || later_by(asked_behind_, taken_) > 0) return repeat();
  // An answer that told where the spindle is was lost, or the question.
  if (!answered_ && usual_question_ == Question::spindle) ask();
}

void BoardLink::take(const Turned& turned) {
  turned_ = turned;
  note_answer(turned.progress.taken);
  note_progress(turned.progress, turned.answers);
}

Seconds BoardLink::rehearse(std::size_t bytes) {
  const Seconds begun = port_.elapsed();
  for (const std::uint64_t end = bytes_sent_ + bytes; bytes_sent_ < end && !error_;) {
    say(Session{.number = care_.session}, std::uint8_t{0});
  }
  static_cast<void>(read_spindle());
  return answer_time_ = port_.elapsed() - begun;
}

bool BoardLink::read_spindle() {
  turned_.reset();
  answered_ = true;  // what went before is over
  ask(Question::spindle);
  while (!turned_ && listen([this] { ask(Question::spindle); })) {
  }
  return turned_.has_value();
}

void BoardLink::doubt(LinkError error, Question again) {
  if (++doubts_ == sure_of_status) {
    error_ = error;
  } else {
    ask(again);
  }
}

void BoardLink::take(const Captured& captured) {
  if ((captured.input & captured_kept) != 0) {
    recalled_ = captured;
    return;
  }
  const auto pressed = static_cast<std::uint16_t>(captured.input & ~(watched() | captured_kept | captured_released));
  pressed_ |= pressed;
  inputs_ |= pressed;
  if ((captured.input & watched()) == 0) return;
  probe_report_.touched = (captured.input & captured_released) == 0;
  if (probe_until_ != until_is(probe_report_.touched)) return;
  probe_report_.happened = news_ = true;
}

void BoardLink::note_inputs(const BoardStatus& status) {
  pressed_ |= static_cast<std::uint16_t>(status.inputs & ~inputs_ & ~unsigned{watched()});
  inputs_ = status.inputs;
}

// A captured may be lost; what it told shows in every status. Where the probe was at the beginning as it is to become,
// its first change is away from that, and the watch begins again.
void BoardLink::note_probe(const BoardStatus& status) {
  if (usual_question_ == Question::status) note_answer(status.taken);
  const bool touched = (status.inputs & watched()) != 0;
  const bool came = std::exchange(probe_report_.touched, touched) != touched;
  if (probe_until_ == ProbeUntil::off) return;
  const bool as_wanted = probe_until_ == until_is(touched);
  const bool kept = (status.state & board_kept) != 0;
  if (as_wanted ? came || kept : kept && !began_as_wanted_) {
    probe_report_.happened = news_ = true;
  } else if (!as_wanted && began_as_wanted_) {
    began_as_wanted_ = kept;
    if (kept) ask(Question::watch);
  }
}

void BoardLink::note_answer(std::uint8_t taken) {
  if (answered_ || static_cast<std::uint8_t>(sent_) != taken) return;
  answered_ = news_ = true;
  answer_time_ = port_.elapsed() - unanswered_since_;
}

void BoardLink::take(const ErrorReport& error) {
  switch (error.reason) {
    case WireError::bad_frame:
    case WireError::out_of_sequence:
    case WireError::queue_full: break;
    case WireError::too_late:
    case WireError::wrong_sums: return;  // what is executed will tell
    case WireError::manual: error_ = LinkError::manual; return;
    default:
      // Of what we sent, or of what it heard in its place?
      refusals_ = error.expected == refused_ ? refusals_ + 1 : 1;
      refused_ = error.expected;
      if (refusals_ == most_refusals) error_ = LinkError::refused;
      break;
  }
  if (!may_lose()) error_ = LinkError::refused;
  note_taken(static_cast<std::uint8_t>(error.expected - 1));
  // What it complains of while something is being repeated is older, or else the answer to the question behind tells.
  if (!repeating_) repeat();
}

// `sequence`: the low byte of a number between the last one known to be taken and the last one sent; else it is old.
void BoardLink::note_taken(std::uint8_t sequence) {
  const auto more = static_cast<std::uint8_t>(sequence - static_cast<std::uint8_t>(taken_));
  if (more == 0 || more > later_by(sent_, taken_)) return;
  taken_ = static_cast<ItemNumber>(taken_ + more);
  moved_on_ = port_.elapsed();
  news_ = true;
  while (!kept_.empty() && later_by(kept_.front().number, taken_) <= 0) kept_.pop_front();
}

// Some of what the board does not have, in order, and a question behind, whose answer tells what is to be repeated
// next. Nothing else is sent meanwhile. All of it each time that the board complains: on a bad line each of many frames
// would bring many more.
void BoardLink::repeat() {
  if (error_ || kept_.empty()) return;
  const std::size_t count = std::min(kept_.size(), repeated_at_once);
  for (std::size_t i = 0; i < count; ++i) put_on_wire(kept_[i].bytes, kept_[i].size);
  frames_repeated_ += count;
  ask();
  repeating_ = care_.session != 0;  // else nobody tells
  repeated_before_ = question_;
}

template <class Message, class... More>
void BoardLink::say(const Message& message, More... more) {
  std::uint8_t frame[largest_frame];
  put_on_wire(frame, encode(message, more..., frame));
}

template <class Message, class... More>
void BoardLink::send_counted(const Message& message, More... more) {
  if (error_) return;
  Frame frame{.number = static_cast<ItemNumber>(sent_ + 1)};
  frame.size = encode(message, more..., static_cast<std::uint8_t>(frame.number), frame.bytes);
  send_frame(frame);
}

// The next one that is counted.
void BoardLink::send_frame(const Frame& frame) {
  if (error_) return;
  sent_ = frame.number;
  rests_ = false;
  if (may_lose()) kept_.push_back(frame);
  answered_ = false;
  unanswered_since_ = port_.elapsed();
  moved_on_ = port_.elapsed();
  if (!repeating_) put_on_wire(frame.bytes, frame.size);
}

void BoardLink::put_on_wire(const std::uint8_t* frame, std::uint8_t size) {
  ++frames_sent_;
  bytes_sent_ += size;
  port_.receive({frame, size});
}

}  // namespace passo
