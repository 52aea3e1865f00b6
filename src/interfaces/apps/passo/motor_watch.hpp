// MotorWatch: monitors the motors of a machine with physics during a run, and relates them to the program lines.
#pragma once

#include <cstdint>
#include <vector>

#include "passo/job/motion_lines.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/plant/rotor_plant.hpp"
#include "passo/report/summary.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo {

class MotorWatch {
 public:
  // `begins`: the board's time at the start of the program. `plant` and `machine` must outlive the watch.
  MotorWatch(RotorPlant& plant, const MachineDescription& machine, Seconds begins);

  // Adds planned motion, in order.
  void plan(const MotionItem& item) { lines_.watch(item); }
  // Must be called after each turn of the session. `now`: the board's time.
  void poll(Seconds now);
  // Waits until the rotors come to rest. `now`: the board's time at the end.
  PhysicsSummary finish(Seconds now);

 private:
  struct Motor {
    const AxisDescription* axis = nullptr;
    double scale = 0;              // steps per unit of the axis; negative: reversed direction
    std::uint32_t worst_line = 0;  // line of the minimum margin
  };

  RotorPlant& plant_;
  Seconds begins_;
  PlannedLines lines_;
  Seconds looked_{-1};
  std::vector<Motor> motors_;  // the motors in the board's order: the second motors of axes follow all the first ones
  std::vector<std::uint32_t> lines_of_losses_;
  std::uint32_t fault_line_ = 0;  // line where the following error exceeded its limit
};

}  // namespace passo
