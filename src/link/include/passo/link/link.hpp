// Link: the host's end of the wire. What is written to a link reaches the board once, whole and in order.
//
// Place on the street: after stepgen, before the board. Credits bound what is under way: who sends looks at room()
// first, so that a job of any length needs no more memory than the board's queue. No function of a link waits. What the
// board has to say is heard in BoardSession::poll(), and settled() tells when an answer has come.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <variant>

#include "passo/link/probe.hpp"
#include "passo/units/units.hpp"
#include "passo/wire/board_segment.hpp"
#include "passo/wire/message.hpp"

namespace passo {

enum class LinkError : std::uint8_t {
  no_answer,       // the board says nothing, though an answer is due
  wrong_version,   // the board speaks another protocol
  too_few_motors,  // the board cannot turn as many motors as the machine has
  refused,         // the board did not take what was sent
  was_reset,       // the board has forgotten the session, and with it where the motors are
  stopped,         // the board has stopped its motors at once
  too_few_places,  // the board cannot hold as many items as it takes to bring the machine to rest
  manual,          // a person moves the machine by the board's keypad, or has since the hello
  no_encoder,      // something is to follow the spindle, and the board has no encoder
  spindle_stands,  // the encoder counts nothing, though the spindle is to turn
  encoder_wrong,   // what the encoder counts from index to index are no turns
  thread_lost,     // the machine had to rest in a thread, because a refill came too late
};
// A sentence without a full stop.
std::string_view message_of(LinkError error);

using LinkItem = std::variant<BoardSegment, BoardOutputs>;
// Counts what is sent, modulo 65536. An item keeps its number for ever.
using ItemNumber = std::uint16_t;
// How much later `a` was sent than `b`; negative: before.
constexpr int later_by(ItemNumber a, ItemNumber b) {
  return static_cast<std::int16_t>(static_cast<ItemNumber>(a - b));
}

class Link {
 public:
  virtual ~Link() = default;
  Link() = default;
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;

  // Only while room() is above 0. Sending never fails by itself: the first error is kept, and nothing is sent after it.
  virtual void send(const BoardSegment& segment) = 0;
  virtual void send(const BoardOutputs& outputs) = 0;
  // Puts `items`, no more than there is room for, in the place of all that the board holds behind item `after`: all of
  // them or, if that is too late or the line breaks, none. Returns the number of the first; the others follow.
  virtual ItemNumber replace(ItemNumber after, std::span<const LinkItem> items) = 0;
  // The number of the last item that was sent.
  virtual ItemNumber sent() const = 0;
  // The last item that is done, as far as the host knows.
  virtual ItemNumber executed() const = 0;
  // How many items the board can take now, for certain; and how many it has places for: no more of them can be under
  // way than there are numbers for.
  virtual int room() const = 0;
  virtual int places() const = 0;

  // The board has said that all that was sent has come, and that it holds nothing and rests: what is not executed never
  // will be.
  virtual bool rests() const = 0;
  // Something that was sent is, as far as the host knows, not done.
  virtual bool busy() const = 0;

  // Questions that must be answered before the host goes on. One at a time; settled() tells that the answer has come.
  //
  // At rest, with all executed that did not come too late: asks how the probe is. From the answer on the board keeps
  // where the probe changes first. With `limit`, the bit of a limit switch, that switch takes the probe's place, and
  // does not stop the motors until the next watch.
  virtual void watch_probe(ProbeUntil until, std::uint8_t limit = 0) = 0;
  // At rest again: asks what the board has kept. After the answer the report has the steps.
  virtual void recall_contact() = 0;
  // Asks where the spindle is; take_turned() has the answer.
  virtual void read_spindle() = 0;
  // At rest: sends so many bytes that say nothing new, and asks where the spindle is. answer_time() then tells how long
  // a refill of that size takes until it is answered.
  virtual void rehearse(std::size_t bytes) = 0;
  // No answer is missing that the host has to wait for. True at an error, too.
  virtual bool settled() const = 0;

  virtual const ProbeReport& probe_report() const = 0;
  // Asks how the board is, amid motion too; what it says of the probe comes into the report.
  virtual void ask() = 0;
  // From now on that question is where the spindle is, or no longer.
  virtual void ask_for_spindle(bool wanted) = 0;
  // The newest answer about the spindle since the last call.
  virtual std::optional<Turned> take_turned() = 0;
  // The board has answered behind all that was sent.
  virtual bool answered() const = 0;
  // How long the last such answer took.
  virtual Seconds answer_time() const = 0;
  // The time on the board's side, from any start.
  virtual Seconds now() const = 0;
  virtual std::optional<LinkError> error() const = 0;
  // Whoever uses the link has found that the work cannot go on.
  virtual void fail(LinkError error) = 0;

  virtual std::uint64_t frames_sent() const = 0;
  virtual std::uint64_t bytes_sent() const = 0;
};

}  // namespace passo
