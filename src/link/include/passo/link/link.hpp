// Link: the host's end of the wire. What is written to it reaches the board once, whole and in order.
//
// Place on the street: after stepgen, before the board. Credits bound what is under way: send() waits while the board's
// queue is full, so that a job of any length needs no more memory than that queue.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "passo/wire/board_segment.hpp"
#include "passo/wire/probe.hpp"

namespace passo {

enum class LinkError : std::uint8_t {
  no_answer,       // the board is at rest and says nothing, though an answer is due
  wrong_version,   // it speaks another protocol
  too_few_motors,  // it cannot turn as many as the machine has
  refused,         // it did not take what was sent
};
// A sentence without a full stop.
std::string_view message_of(LinkError error);

class Link {
 public:
  virtual ~Link() = default;
  Link() = default;
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;

  // Never fail on their own: the first error is kept, and nothing is sent after it.
  virtual void send(const BoardSegment& segment) = 0;
  virtual void send(const BoardOutputs& outputs) = 0;
  virtual void send(const ProbeWatch& watch) = 0;
  // Waits until the board has executed all that was sent.
  virtual void drain() = 0;
  // Whether something that was sent is, as far as we know, not done.
  virtual bool busy() const = 0;
  // While it is busy: waits until the board has done one more of them, or tells of its probe.
  virtual void wait() = 0;
  // What the board told of its probe last, since the last watch was sent.
  virtual const std::optional<ProbeReport>& probe_report() const = 0;
  virtual std::optional<LinkError> error() const = 0;

  virtual std::uint64_t frames_sent() const = 0;
  virtual std::uint64_t bytes_sent() const = 0;
};

}  // namespace passo
