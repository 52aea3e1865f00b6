// GrblTimes: when a program reaches each of its points on a Grbl board, by the model of the board's own planner. It
// gives the remaining time of a job.
//
// Position in the pipeline: beside GrblMotion, which predicts the same motion in the form of planned moves. A point is
// identified by its nominal time (activity/nominal_time.hpp), as in the progress reports of GrblMachineSession.
//
// Waits for the operator and for a spindle are not included.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "passo/activity/program.hpp"
#include "passo/sender/grbl_code.hpp"
#include "passo/sender/grbl_forecast.hpp"
#include "passo/trajectory/motion_limits.hpp"

namespace passo {

// The board and its connection. The limits include the overrides.
struct GrblTiming {
  GrblLimits limits;
  GrblLine line;
  GrblTarget target;

  // Returns whether the motion of the board can be predicted: it has told its steps, speeds and accelerations.
  bool is_known() const;
};

class GrblTimes {
 public:
  // Receives points of the program in order: both times increase.
  using Listener = std::function<void(Seconds nominal, Seconds planned)>;

  // The program must have passed the check of the machine's session. `machine` must outlive this object.
  GrblTimes(const ProgramReader& program, const MachineDescription& machine, const InterpreterOptions& options,
            const GrblTiming& timing, Listener listener);

  // Predicts some more items. Returns true after the last one.
  [[nodiscard]] bool go_on(std::uint64_t items);

 private:
  // A segment whose motion is not complete.
  struct Item {
    std::uint32_t number = 0;
    Seconds begin{0};  // nominal
    Seconds time{0};
    double length = 0;
    double done = 0;
  };

  void add(const PathItem& item);
  void add(const GrblPhase& phase);

  Diagnostics unheard_;
  MotionLimits nominal_limits_;
  ProgramChecker checker_;
  GrblCode code_;
  GrblForecast forecast_;
  Listener listener_;
  std::vector<std::string> lines_;
  std::deque<Item> items_;
  std::uint32_t last_number_ = 0;
  Seconds nominal_{0};  // of all items so far
  bool ended_ = false;
};

}  // namespace passo
