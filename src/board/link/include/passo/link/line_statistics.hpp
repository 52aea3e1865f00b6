// LineStatistics: counts the bytes sent to a board and the repeated ones, and measures how fast the board accepts
// frames.
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
  // A burst: frames sent until the board has accepted all of them. The board's pace is measured in long bursts.
  void begin_burst(Seconds now) { burst_began_ = now; }
  void record_in_burst() { ++burst_; }
  void end_burst(Seconds now);
  // Call for another board: its pace is unknown.
  void forget_pace();

  std::uint64_t frames() const { return frames_; }
  std::uint64_t bytes() const { return bytes_; }
  std::uint64_t repeated() const { return repeated_; }
  // Returns the recent time per frame of a long burst, including the transmission; 0: unknown.
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
