// LoadTrack: the torque utilisation of the motors and the speed of the tool over the duration of the motion.
//
// The duration is divided into intervals of equal length. When there are too many, each pair is merged. Memory is
// therefore bounded, whatever the program, and every peak is kept: an interval keeps its greatest load, with the line.
#pragma once

#include <cstdint>
#include <vector>

#include "passo/units/units.hpp"

namespace passo {

class LoadTrack {
 public:
  static constexpr std::size_t most_stretches = 1024;

  struct Stretch {
    double load = 0;         // fraction of the guaranteed torque needed at the worst moment
    std::uint32_t line = 0;  // program line at that moment; without a known motor, at the end
    Mm way{0};
    Seconds time{0};  // elapsed time in the interval: length(), except in the last one

    MmPerSecond mean_speed() const { return time > Seconds(0) ? way / time : MmPerSecond(0); }
  };

  // Adds the motion of a phase, or another piece with a single load.
  void add(Seconds duration, Mm way, double load, std::uint32_t line);

  const std::vector<Stretch>& stretches() const { return stretches_; }
  Seconds length() const { return length_; }  // the length of an interval

 private:
  void make_room();

  std::vector<Stretch> stretches_;
  Seconds length_{1.0 / 1024};
};

}  // namespace passo
