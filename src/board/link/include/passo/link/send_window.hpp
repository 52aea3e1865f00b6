// SendWindow: the counted frames on their way to a board, each kept until the board has taken it. The sender's half of
// a sliding window: frames go in order, and where the board misses one, all go again from there (go-back-N).
//
// Between two frames that are counted, others may go: greetings and questions. They are sent at once and not kept.
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

  // A sequence number is a byte. Half of the numbers are reserved for frames that come again.
  static constexpr int most_untaken = 127;
  static constexpr std::size_t no_limit = std::numeric_limits<std::size_t>::max();

  // `keeps`: frames may be lost on the way. Where nothing is lost, each frame goes to the board at once, and none is
  // kept. The port outlives the window.
  SendWindow(BoardPort& port, bool keeps) : port_(port), keeps_(keeps) {}

  // The frame after `number` is the next one, and nothing is under way.
  void begin(ItemNumber number);

  // The numbers of the last frame that was pushed, of the last one that was put on the wire, and of the last one that
  // the board has, as it told.
  ItemNumber sent() const { return sent_; }
  ItemNumber on_wire() const { return on_wire_; }
  ItemNumber taken() const { return taken_; }
  ItemNumber next() const { return static_cast<ItemNumber>(sent_ + 1); }
  int untaken() const { return later_by(sent_, taken_); }
  // True: frames still wait until the board can keep them.
  bool waits() const { return on_wire_ != sent_; }
  // True: frames are kept until the board has told that it has them.
  bool keeps_any() const { return !kept_.empty(); }

  // Adds the frame next(). fill() puts it on the wire.
  void push(const Frame& frame);
  // Puts frames on the wire as long as at most `most_bytes` are under way. True: none waits.
  [[nodiscard]] bool fill(std::size_t most_bytes);
  // The board has all frames up to the one with this low byte. False: that is old, or of no frame that was sent.
  [[nodiscard]] bool on_accepted(std::uint8_t sequence);
  // Puts the first of the frames that the board does not have on the wire again, in order.
  void repeat(std::size_t most_bytes);
  // The answer to this question tells whether the repeated frames have arrived. Until go_on(), no frame is put on the
  // wire.
  void await_answer(std::uint8_t question);
  bool awaits_answer() const { return repeats_; }
  bool awaits_answer(std::uint8_t question) const { return repeats_ && question == question_; }
  void go_on() { repeats_ = false; }

  // Sends a frame that is not counted.
  void put(std::span<const std::uint8_t> frame);

  const LineStatistics& statistics() const { return statistics_; }

 private:
  void put_counted(const Frame& frame);

  BoardPort& port_;
  bool keeps_;
  ItemNumber sent_ = 0;
  ItemNumber on_wire_ = 0;
  ItemNumber taken_ = 0;
  std::deque<Frame> kept_;     // sent and, as far as the host knows, not taken
  bool repeats_ = false;       // frames were repeated, and the answer after them was not heard
  std::uint8_t question_ = 0;  // the one after the frames that were repeated last
  LineStatistics statistics_;
};

}  // namespace passo
