// InProcessLink: a link to a board in this very process. The bytes are those that a serial line would carry.
//
// The board plays only when the host has to wait for it: with no credit left, in wait() and in drain(). So its queue is
// as full as the host wants it, and a run gives the same bytes every time. Nothing is lost on the way; an error that
// the board reports is therefore a bug on one of the two sides, and final.
#pragma once

#include <cstdint>
#include <optional>

#include "passo/link/board_port.hpp"
#include "passo/link/link.hpp"
#include "passo/wire/decoder.hpp"
#include "passo/wire/message.hpp"

namespace passo {

class InProcessLink final : public Link {
 public:
  // Says hello: from here on both sides count the motors' fractions from the start. The port outlives the link.
  InProcessLink(BoardPort& port, std::uint8_t motors);

  void send(const BoardSegment& segment) override;
  void send(const BoardOutputs& outputs) override;
  void send(const ProbeWatch& watch) override;
  void drain() override;
  bool busy() const override { return under_way() > 0; }
  void wait() override;
  const std::optional<ProbeReport>& probe_report() const override { return probe_report_; }
  std::optional<LinkError> error() const override { return error_; }

  std::uint64_t frames_sent() const override { return frames_sent_; }
  std::uint64_t bytes_sent() const override { return bytes_sent_; }
  // What the board said it is; nothing where it did not answer.
  const std::optional<HelloReply>& board() const { return board_; }

 private:
  void say_hello();
  bool wait_for_credit();
  bool listen();
  void take(const WireFrame& frame);
  void put_on_wire(const std::uint8_t* frame, std::uint8_t size);
  // Items that were sent and, as far as we know, are not done.
  std::uint8_t under_way() const { return static_cast<std::uint8_t>(last_sent_ - last_executed_); }

  BoardPort& port_;
  std::uint8_t motors_;
  Decoder decoder_;
  std::optional<HelloReply> board_;
  std::optional<LinkError> error_;
  std::optional<ProbeReport> probe_report_;
  std::uint8_t last_sent_ = 0;      // sequence number of the last item sent
  std::uint8_t last_executed_ = 0;  // of the last one that the board told to be done
  std::uint64_t frames_sent_ = 0;
  std::uint64_t bytes_sent_ = 0;
};

}  // namespace passo
