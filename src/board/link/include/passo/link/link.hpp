// Link: the host's end of the wire. All that is written to a link reaches the board once, whole and in order.
//
// Place on the street: after stepgen, before the board. Credits bound how much is under way: a sender checks room()
// first, so a job of any length needs no more memory than the board's queue. No function of a link waits.
// BoardSession::poll() hears what the board says, and settled() tells when an answer has come.
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
  no_answer,       // the board is silent, though an answer is due
  no_progress,     // the board, or what is in its place, talks, and does nothing of what it was told
  wrong_version,   // the board speaks another protocol
  too_few_motors,  // the board has fewer motors than the machine
  cannot_set_up,   // the board cannot do what the host says of its pins
  cannot_time,     // the board cannot make its step pulses as long, or its events as fast, as the host needs
  cannot_watch,    // the board cannot watch these limit switches at once
  refused,         // the board did not take what was sent
  was_reset,       // the board has forgotten the session, and with it where the motors are
  stopped,         // the board has stopped its motors at once
  drivers_off,     // the board has switched the drivers off, because it has not heard the host for so long
  stood_still,     // the board could not make its events in time: motors stopped amid motion
  too_few_places,  // the board cannot hold enough items to bring the machine to rest
  manual,          // a person moves the machine by the board's keypad, or has done so since the hello
  no_encoder,      // something is to follow the spindle, and the board has no encoder
  spindle_stands,  // the encoder counts nothing, though the spindle is to turn
  encoder_wrong,   // the counts from index to index are not whole turns
  thread_lost,     // the machine had to rest in a thread, because a refill came too late
  thread_outrun,   // the axes could not keep up with the spindle in a thread
};
// A stable code, e.g. "link.no-answer".
std::string_view code_of(LinkError error);
// A sentence without a full stop.
std::string_view message_of(LinkError error);

using LinkItem = std::variant<BoardSegment, BoardOutputs>;
// The number of a frame that was sent, modulo 65536. An item keeps its number for ever.
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

  // Send only while room() is above 0. Sending itself never fails: the link keeps the first error, and sends nothing
  // after an error.
  virtual void send(const BoardSegment& segment) = 0;
  virtual void send(const BoardOutputs& outputs) = 0;
  // Replaces all that the board holds after item `after` by `items`, of which there are no more than room() allows. The
  // board takes all of the items, or none if they come too late or the line breaks. Returns the number of the first
  // item; the others follow.
  virtual ItemNumber replace(ItemNumber after, std::span<const LinkItem> items) = 0;
  // The number of the last item that was sent.
  virtual ItemNumber sent() const = 0;
  // The number of the last item that is done, as far as the host knows.
  virtual ItemNumber executed() const = 0;
  // room(): how many items the board can take now, for certain. No more can be under way than there are sequence
  // numbers for. places(): how many free places the board has.
  virtual int room() const = 0;
  virtual int places() const = 0;

  // True: the board has said that all frames have arrived, and that the board holds nothing and rests. Items that are
  // not executed by then never will be.
  virtual bool rests() const = 0;
  // True: something that was sent is, as far as the host knows, not done.
  virtual bool busy() const = 0;
  // True: the board did not hear the host for so long that it has switched outputs off. It takes no replacement before
  // outputs are sent alone.
  virtual bool outputs_timed_out() const { return false; }

  // Questions that must be answered before the host goes on. Only one may be open at a time. settled() tells when the
  // answer has come.
  //
  // Asks how the probe is. Call at rest, with all items executed that did not come too late. From the answer on, the
  // board keeps where the probe changes first. With `limit`, the bit of a limit switch, that switch takes the probe's
  // place and does not stop the motors until the next watch.
  virtual void watch_probe(ProbeUntil until, std::uint8_t limit = 0) = 0;
  // Asks, at rest again, what the board has kept. After the answer the report has the steps.
  virtual void recall_contact() = 0;
  // Asks where the spindle is; take_turned() has the answer.
  virtual void read_spindle() = 0;
  // Sends, at rest, at least `bytes` bytes that say nothing new, and asks where the spindle is. answer_time() then
  // tells how long a refill of that size takes until the board has answered.
  virtual void rehearse(std::size_t bytes) = 0;
  // True: the host does not have to wait for an answer. Also true after an error.
  virtual bool settled() const = 0;

  virtual const ProbeReport& probe_report() const = 0;
  // Asks for the board's status, even during motion. The report takes what the answer says of the probe.
  virtual void ask() = 0;
  // From now on ask() asks where the spindle is, or, if not `wanted`, for the status again.
  virtual void ask_for_spindle(bool wanted) = 0;
  // The newest answer about the spindle since the last call.
  virtual std::optional<Turned> take_turned() = 0;
  // True: the board has answered after all frames that were sent.
  virtual bool answered() const = 0;
  // How long the last such answer took.
  virtual Seconds answer_time() const = 0;
  // The time on the board's side, from any start.
  // How long the board took lately to take a frame of many that were sent at once, the line's time included; 0:
  // unknown.
  virtual Seconds time_a_frame() const = 0;
  virtual Seconds now() const = 0;
  virtual std::optional<LinkError> error() const = 0;
  // Sets the error because a user of the link has found that the work cannot go on. The first error is kept.
  virtual void fail(LinkError error) = 0;

  virtual std::uint64_t frames_sent() const = 0;
  virtual std::uint64_t bytes_sent() const = 0;
};

}  // namespace passo
