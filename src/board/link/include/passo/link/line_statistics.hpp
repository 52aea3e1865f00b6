// LineStatistics: how much went to a board, how much of it again, and how fast the board takes frames.
#pragma once

#include <cstddef>
#include <cstdint>

#include "passo/units/units.hpp"

namespace passo {

class LineStatistics {
 public:
  void record_sent(std::size_t bytes) {
    ++frames_;
    bytes_ += bytes;
  }
  void record_repeated(int frames) { repeated_ += static_cast<std::uint64_t>(frames); }
  // A burst: frames sent until the board has taken all. The board's pace follows from long bursts.
  void begin_burst(Seconds now) { burst_began_ = now; }
  void record_in_burst() { ++burst_; }
  void end_burst(Seconds now);
  // Another board: its pace is unknown.
  void forget_pace();

  std::uint64_t frames() const { return frames_; }
  std::uint64_t bytes() const { return bytes_; }
  std::uint64_t repeated() const { return repeated_; }
  // How long the board took lately to take a frame of a long burst, the line's time included; 0: unknown.
  Seconds time_a_frame() const { return time_a_frame_; }

 private:
  std::uint64_t frames_ = 0;
  std::uint64_t bytes_ = 0;
  std::uint64_t repeated_ = 0;
  std::size_t burst_ = 0;  // frames sent since the burst began
  Seconds burst_began_{0};
  Seconds time_a_frame_{0};
};

}  // namespace passo
