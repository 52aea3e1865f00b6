// SendWindow: the numbered frames on their way to a board, each kept until the board has acknowledged it. It is the
// sender's half of a sliding window: frames are sent in order, and if the board misses one, all are repeated from there
// (go-back-N).
//
// Other frames may be sent between numbered ones: handshakes and queries. They are sent immediately and not kept.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <span>

#include "passo/link/board_port.hpp"
#include "passo/link/line_statistics.hpp"
#include "passo/link/link.hpp"
#include "passo/wire/wire_frame.hpp"

namespace passo {

class SendWindow {
 public:
  struct Frame {
    ItemNumber number = 0;
    std::uint8_t size = 0;
    std::uint8_t bytes[largest_frame] = {};
  };

  // A sequence number is a byte. Half of the numbers are reserved for repeated frames.
  static constexpr int most_untaken = 127;
  static constexpr std::size_t no_limit = std::numeric_limits<std::size_t>::max();

  // `keeps`: frames may be lost. On a link that loses nothing, each frame is sent immediately, and none is kept. The
  // port must outlive the window.
  SendWindow(BoardPort& port, bool keeps) : port_(port), keeps_(keeps) {}

  // Starts with the frame after `number`, with nothing unacknowledged.
  void begin(ItemNumber number);

  // The number of the last frame that was pushed; of the last that was sent; of the last that the board has
  // acknowledged.
  ItemNumber sent() const { return sent_; }
  ItemNumber on_wire() const { return on_wire_; }
  ItemNumber taken() const { return taken_; }
  ItemNumber next() const { return static_cast<ItemNumber>(sent_ + 1); }
  int untaken() const { return later_by(sent_, taken_); }
  // Returns whether some frames still wait to be sent.
  bool waits() const { return on_wire_ != sent_; }
  // Returns whether some frames are not acknowledged yet.
  bool keeps_any() const { return !kept_.empty(); }

  // Adds the frame next(). fill() sends it.
  void push(const Frame& frame);
  // Sends frames as long as at most `most_bytes` bytes are unacknowledged. Returns true if no frame is left to send.
  [[nodiscard]] bool fill(std::size_t most_bytes);
  // Acknowledges all frames up to the one with this low byte. Returns false for an old acknowledgement or an unknown
  // frame.
  [[nodiscard]] bool on_accepted(std::uint8_t sequence);
  // Repeats the first unacknowledged frames, in order.
  void repeat(std::size_t most_bytes);
  // Waits for the answer to this query, which shows whether the repeated frames have arrived. No frame is sent until
  // go_on().
  void await_answer(std::uint8_t question);
  bool awaits_answer() const { return repeats_; }
  bool awaits_answer(std::uint8_t question) const { return repeats_ && question == question_; }
  void go_on() { repeats_ = false; }

  // Sends a frame that is not numbered.
  void put(std::span<const std::uint8_t> frame);

  const LineStatistics& statistics() const { return statistics_; }

 private:
  void put_counted(const Frame& frame);

  BoardPort& port_;
  bool keeps_;
  ItemNumber sent_ = 0;
  ItemNumber on_wire_ = 0;
  ItemNumber taken_ = 0;
  std::deque<Frame> kept_;     // sent, but not acknowledged
  bool repeats_ = false;       // frames were repeated, and the answer is still due
  std::uint8_t question_ = 0;  // the query after the last repeated frames
  LineStatistics statistics_;
};

}  // namespace passo
