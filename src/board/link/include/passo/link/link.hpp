// Link: the host's end of the wire protocol. Everything that is sent reaches the board once, complete and in order.
//
// Position in the pipeline: after stepgen, before the board. Credits limit the unexecuted items: check room() before
// sending, so that a job of any length needs no more memory than the board's queue. No function of a link waits.
// BoardSession::poll() processes the board's messages, and settled() shows when an answer has arrived.
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
  no_answer,       // the board does not answer
  no_progress,     // bytes arrive, but the board (or another device) does not execute anything
  wrong_version,   // the board uses another protocol version
  too_few_motors,  // the board has fewer motors than the machine
  cannot_set_up,   // the board does not support the pin set-up
  cannot_time,     // the board cannot make the required step timing or event rate
  cannot_watch,    // the board cannot watch these limit switches at the same time
  refused,         // the board rejected a message
  was_reset,       // the board was reset, so the positions of its motors are lost
  stopped,         // the board has stopped its motors instantly
  drivers_off,     // the board has switched the drivers off after a silence of the host
  stood_still,     // the board could not make its events in time: motors stopped during motion
  too_few_places,  // the board's queue is too short for the stop ramp
  manual,          // the machine is, or was since the handshake, moved with the board's keypad
  no_encoder,      // motion must follow the spindle, but the board has no encoder
  spindle_stands,  // the encoder counts nothing, although the spindle is on
  encoder_wrong,   // the counts from index to index are not whole revolutions
  thread_lost,     // the machine stopped in a thread, because a queue update came too late
  thread_outrun,   // the axes could not keep up with the spindle in a thread
};
// A stable code, e.g. "link.no-answer".
std::string_view code_of(LinkError error);
// A sentence without a full stop.
std::string_view message_of(LinkError error);

using LinkItem = std::variant<BoardSegment, BoardOutputs>;
// The number of a sent frame, modulo 65536. An item keeps its number.
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

  // Call only while room() is above 0. Sending never fails: the link keeps the first error, and sends nothing after it.
  virtual void send(const BoardSegment& segment) = 0;
  virtual void send(const BoardOutputs& outputs) = 0;
  // Queue update: replaces the board's queue after item `after` by `items`, at most as many as room() allows. The board
  // accepts all of the items, or none if they come too late or the connection breaks. Returns the number of the first
  // item; the others follow.
  virtual ItemNumber replace(ItemNumber after, std::span<const LinkItem> items) = 0;
  // The number of the last sent item.
  virtual ItemNumber sent() const = 0;
  // The number of the last executed item, as last reported.
  virtual ItemNumber executed() const = 0;
  // room(): the number of items that the board can certainly accept now, also limited by the sequence numbers.
  // places(): the number of free places in the board's queue.
  virtual int room() const = 0;
  virtual int places() const = 0;

  // Returns true if the board has reported that all frames have arrived, that its queue is empty, and that it is
  // stopped. Items that are not executed by then never will be.
  virtual bool rests() const = 0;
  // Returns true if some sent items have not been reported as executed.
  virtual bool busy() const = 0;
  // Returns true if the board has switched its outputs off after a silence of the host. It accepts no queue update
  // until the host has sent outputs in a separate message.
  virtual bool outputs_timed_out() const { return false; }

  // Queries that must be answered before the host continues. Only one may be open at a time. settled() shows when the
  // answer has arrived.
  //
  // Starts watching the probe. Call it while the board is stopped, with all items executed except those that came too
  // late. After the answer, the board captures the position of the probe's first change. With `limit`, the bit of a
  // limit switch, that switch acts as the probe, and does not stop the motors until the next watch.
  virtual void watch_probe(ProbeUntil until, std::uint8_t limit = 0) = 0;
  // Reads the captured position, while the board is stopped again. After the answer, the report contains the steps.
  virtual void recall_contact() = 0;
  // Queries the spindle's angle; take_turned() returns the answer.
  virtual void read_spindle() = 0;
  // Sends at least `bytes` filler bytes while the board is stopped, and queries the spindle. answer_time() then gives
  // the response time of a queue update of that size.
  virtual void rehearse(std::size_t bytes) = 0;
  // Returns true if no answer is due. Also true after an error.
  virtual bool settled() const = 0;

  virtual const ProbeReport& probe_report() const = 0;
  // Queries the board's status, even during motion. The report is updated with the probe's state in the answer.
  virtual void ask() = 0;
  // Selects what ask() queries: the spindle's angle, or, if not `wanted`, the status.
  virtual void ask_for_spindle(bool wanted) = 0;
  // The newest answer about the spindle since the last call.
  virtual std::optional<Turned> take_turned() = 0;
  // Returns true if the board has answered after all sent frames.
  virtual bool answered() const = 0;
  // The response time of the last such answer.
  virtual Seconds answer_time() const = 0;
  // now(): the time on the board's side, from an arbitrary zero. time_a_frame(): the recent time per frame of a long
  // burst, including the transmission; 0: unknown.
  virtual Seconds time_a_frame() const = 0;
  virtual Seconds now() const = 0;
  virtual std::optional<LinkError> error() const = 0;
  // Sets an error that a user of the link has detected. The first error is kept.
  virtual void fail(LinkError error) = 0;

  virtual std::uint64_t frames_sent() const = 0;
  virtual std::uint64_t bytes_sent() const = 0;
};

}  // namespace passo
