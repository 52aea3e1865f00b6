// StepPeaks: velocity and acceleration of each axis, computed only from the board's steps.
//
// Board segments are simulated from the definition in wire/board_segment.hpp, and the step counts are read every
// millisecond. Over a window of T = 10 ms the first difference of the position gives a mean velocity, the second a mean
// acceleration:
//
//   (q(t) − q(t−T)) / T       (q(t) − 2 q(t−T) + q(t−2T)) / T²
//
// If the limit falls with the speed, the limit at the lowest possible speed of the window applies: the speed of the
// slower half of the window, less the speed change in T under the constant limit.
//
// With a start-stop velocity s the velocity jumps at a stop, from one velocity of at most s to another. With such a
// jump in the window, no speed in the window exceeds s + 2 A T, and the mean acceleration exceeds A by at most 2 s / T
// (the first jump in each T begins at -s at least, and the last one ends at s). That part is not counted.
//
// Neither can exceed its limit except by rounding. A count is within a step of the true position: half a step of
// rounding, and the same for steps that wait for the event clock. That adds up to 2 steps/T and 4 steps/T².
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "speed_limit.hpp"

#include "passo/proof/motion_proof.hpp"

namespace passo::proof {

class StepPeaks {
 public:
  StepPeaks(const ProofOptions& options, MotionProof& proof);

  void watch(const BoardSegment& segment);
  void finish();

 private:
  static constexpr std::size_t samples_in_window = 10;
  static constexpr std::size_t kept = 2 * samples_in_window + 1;

  void sample();
  void difference(std::size_t m);
  double of_jumps(std::size_t m, double faster) const;
  std::int64_t before(std::size_t m, std::size_t samples) const;

  MotionProof& proof_;
  std::vector<SpeedLimit> limits_;   // by motor
  std::vector<double> start_stop_;   // mm/s, by motor
  std::vector<double> step_;         // mm; 0: not checked
  std::vector<std::int64_t> place_;  // 1/65536 step, by motor
  std::int64_t time_ = 32768;        // 1/65536 tick
  double tick_rate_;
  std::int64_t between_samples_;  // 1/65536 tick
  std::int64_t next_sample_ = 0;
  std::vector<std::array<std::int64_t, kept>> counts_;  // whole steps; a ring for each motor
  std::size_t sampled_ = 0;
};

}  // namespace passo::proof
