// LoadTrack: how much of their torque the motors need, and how fast the tool is, along the time of the motion.
//
// The time is cut into stretches of equal length. When there are too many, each two become one. So memory is bounded,
// whatever the program, and a peak of any length stays: a stretch keeps its greatest load, with the line.
#pragma once

#include <cstdint>
#include <vector>

#include "passo/units/units.hpp"

namespace passo {

class LoadTrack {
 public:
  static constexpr std::size_t most_stretches = 1024;

  struct Stretch {
    double load = 0;         // the share of the sure torque that is needed at the worst moment
    std::uint32_t line = 0;  // of the program, there; where no motor is known, at the end
    Mm way{0};
    Seconds time{0};  // that has passed in it: all of length(), but for the last stretch

    MmPerSecond mean_speed() const { return time > Seconds(0) ? way / time : MmPerSecond(0); }
  };

  // The motion of a phase, or another piece with one load.
  void add(Seconds duration, Mm way, double load, std::uint32_t line);

  const std::vector<Stretch>& stretches() const { return stretches_; }
  Seconds length() const { return length_; }  // of a stretch

 private:
  void make_room();

  std::vector<Stretch> stretches_;
  Seconds length_{1.0 / 1024};
};

}  // namespace passo
