// ProgramTimes: how long programs take, and the time left of a job, from their planned motion. Private to api/.
#pragma once

#include <cstdint>
#include <optional>

#include "api_shared.hpp"
#include "job_runner.hpp"

namespace passo {

class ProgramTimes {
 public:
  // Both outlive this.
  ProgramTimes(const ApiShared& shared, const JobRunner& jobs) : shared_(shared), jobs_(jobs) {}

  // First the job that runs is timed, with its overrides, then each program that was checked.
  void poll();
  // Of the job that runs, as far as it is known.
  std::optional<Seconds> left(const MachineStatus& status) const;

 private:
  void record(const MotionTimes& times);
  const StoredProgram* next(const MotionFactors& factors) const;

  const ApiShared& shared_;
  const JobRunner& jobs_;
  // The program that is timed or was timed last, and its times, as far as they are known.
  std::uint64_t timed_ = 0;
  std::uint64_t timed_path_ = 0;
  MotionFactors timed_factors_;  // of the order
  bool is_timing_ = false;
  std::optional<MotionTimes> times_;  // of that program
  MotionFactors times_factors_;       // those that they were planned with
};

}  // namespace passo
