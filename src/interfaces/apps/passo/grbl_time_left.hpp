// The times of programs on a Grbl board, by the model of its own planner (GrblTimes).
#pragma once

#include <atomic>
#include <functional>
#include <future>
#include <memory>
#include <optional>

#include "passo/api/motion_times.hpp"
#include "passo/sender/grbl_times.hpp"
#include "passo/session/machine_status.hpp"

namespace passo {

// What a board has told of its planner. `bytes_per_second`: of the connection; 0: without limit.
GrblTiming grbl_timing_of(const GrblMachine& board, double bytes_per_second);

// Predicts a program with these overrides. Calls `goes_on` repeatedly; returns nothing if it returns false.
std::optional<MotionTimes> predict_on_grbl(const ProgramReader& program, const MachineDescription& machine,
                                           const InterpreterOptions& options, GrblTiming timing,
                                           const MotionFactors& factors, const std::function<bool()>& goes_on);

// GrblTimeLeft: the remaining time of one running program. It is predicted in a thread, and again when the overrides
// change.
class GrblTimeLeft {
 public:
  // The program has passed its check. `nominal`: its nominal time. `machine` must outlive this object.
  GrblTimeLeft(ProgramReader program, const MachineDescription& machine, InterpreterOptions options, GrblTiming timing,
               Seconds nominal);
  ~GrblTimeLeft();
  GrblTimeLeft(const GrblTimeLeft&) = delete;
  GrblTimeLeft& operator=(const GrblTimeLeft&) = delete;

  // Empty: it is not known yet.
  std::optional<Seconds> left(const MachineStatus& status);

 private:
  ProgramReader program_;
  const MachineDescription& machine_;
  InterpreterOptions options_;
  GrblTiming timing_;
  Seconds nominal_;
  MotionFactors factors_;  // of the last prediction
  std::optional<MotionTimes> times_;
  std::atomic<bool> ends_{false};
  std::future<std::optional<MotionTimes>> prediction_;  // valid while it is being made
};

}  // namespace passo
