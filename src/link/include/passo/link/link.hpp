// Link: the host's end of the wire. What is written to it reaches the board once, whole and in order.
//
// Place on the street: after stepgen, before the board. Credits bound what is under way: send() waits while the board's
// queue is full, so that a job of any length needs no more memory than that queue.
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
  wrong_version,   // it speaks another protocol
  too_few_motors,  // it cannot turn as many as the machine has
  refused,         // it did not take what was sent
  was_reset,       // it has forgotten the session, and with it where the motors are
  stopped,         // it has stopped its motors at once
  too_few_places,  // it cannot hold as many items as it takes to bring the machine to rest
  manual,          // a person moves the machine by the board's keypad, or has since the hello
  no_encoder,      // something is to follow the spindle, and it has no encoder
  spindle_stands,  // the encoder counts nothing, though the spindle is to turn
  encoder_wrong,   // what it counts from index to index are no turns
  thread_lost,     // the machine had to rest in a thread, for want of what came too late
};
// A sentence without a full stop.
std::string_view message_of(LinkError error);

using LinkItem = std::variant<BoardSegment, BoardOutputs>;
// Counts what is sent, modulo 65536. An item has one of its own for ever.
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

  // Never fail on their own: the first error is kept, and nothing is sent after it.
  virtual void send(const BoardSegment& segment) = 0;
  virtual void send(const BoardOutputs& outputs) = 0;
  // Puts `items`, no more than there is room for, in the place of all that the board holds behind item `after`: all of
  // them or, if that is too late or the line breaks, none. Returns the number of the first; the others follow.
  virtual ItemNumber replace(ItemNumber after, std::span<const LinkItem> items) = 0;
  // The number of the last one that was sent.
  virtual ItemNumber sent() const = 0;
  // The last item that is done, as far as we know.
  virtual ItemNumber executed() const = 0;
  // How many items the board can take now, for certain; and how many it has places for: no more of them can be under
  // way than there are numbers for.
  virtual int room() const = 0;
  virtual int places() const = 0;

  // It has said that all that was sent has come, and that it holds nothing and rests: what is not executed never will
  // be.
  virtual bool rests() const = 0;

  // Waits until the board has executed all that was sent.
  virtual void drain() = 0;
  // Whether something that was sent is, as far as we know, not done.
  virtual bool busy() const = 0;
  // Waits until the board has told something new: it has done one more item, taken what was sent, or
  // seen what its probe is watched for.
  virtual void wait() = 0;
  // At rest, with all that was not too late executed: asks how the probe is. From now on the board keeps where it
  // changes first. With `limit`, the bit of a limit switch, that one takes the probe's place, and does not stop the
  // motors until the next watch.
  virtual void watch_probe(ProbeUntil until, std::uint8_t limit = 0) = 0;
  virtual const ProbeReport& probe_report() const = 0;
  // At rest again: asks what the board has kept. Only then the report has the steps.
  virtual void recall_contact() = 0;
  // Asks how the board is, amid motion too; what it says of the probe comes into the report.
  virtual void ask() = 0;
  // From now on that question is where the spindle is, or no more.
  virtual void ask_for_spindle(bool wanted) = 0;
  // What it answered to that last, since this was asked.
  virtual std::optional<Turned> take_turned() = 0;
  // It has said so behind all that was sent.
  virtual bool answered() const = 0;
  // How long that took when it last did.
  virtual Seconds answer_time() const = 0;
  virtual std::optional<LinkError> error() const = 0;
  // Whoever uses the link has found that it cannot go on.
  virtual void fail(LinkError error) = 0;

  virtual std::uint64_t frames_sent() const = 0;
  virtual std::uint64_t bytes_sent() const = 0;
};

}  // namespace passo
