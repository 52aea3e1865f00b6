// ProgramTimes: the duration of programs, and the remaining time of a job, from their planned motion. Private to api/.
#pragma once

#include <cstdint>
#include <optional>

#include "api_shared.hpp"
#include "job_runner.hpp"

namespace passo {

class ProgramTimes {
 public:
  // Both must outlive this object.
  ProgramTimes(const ApiShared& shared, const JobRunner& jobs) : shared_(shared), jobs_(jobs) {}

  // Starts computing durations: first for the running job, with its overrides, then for each checked program.
  void poll();
  // Returns the remaining time of the running job, if it is known.
  std::optional<Seconds> left(const MachineStatus& status) const;

 private:
  void record(const MotionTimes& times);
  const StoredProgram* next(const MotionFactors& factors) const;

  const ApiShared& shared_;
  const JobRunner& jobs_;
  // The program whose duration is or was computed last, and the result, if it is known.
  std::uint64_t timed_ = 0;
  std::uint64_t timed_path_ = 0;
  MotionFactors timed_factors_;  // the motion factors of the current order
  bool is_timing_ = false;
  std::optional<MotionTimes> times_;  // the result for that program
  MotionFactors times_factors_;       // the factors with which they were planned
  std::uint64_t basis_ = 0;           // of the timer
};

}  // namespace passo
