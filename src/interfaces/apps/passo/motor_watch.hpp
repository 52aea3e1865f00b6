// MotorWatch: what the motors of a machine with physics do during a run, with the program's lines.
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
  // `begins`: the board's time when the program begins. `plant` and `machine` outlive the watch.
  MotorWatch(RotorPlant& plant, const MachineDescription& machine, Seconds begins);

  // What is planned, in order.
  void plan(const MotionItem& item) { lines_.watch(item); }
  // Call after each turn of the session. `now`: the board's time.
  void poll(Seconds now);
  // Lets the rotors come to rest. `now`: the board's time at the end.
  PhysicsSummary finish(Seconds now);

 private:
  struct Motor {
    const AxisDescription* axis = nullptr;
    double scale = 0;              // steps a unit of the axis; negative: it turns the other way
    std::uint32_t worst_line = 0;  // of the least margin
  };

  RotorPlant& plant_;
  Seconds begins_;
  PlannedLines lines_;
  Seconds looked_{-1};
  std::vector<Motor> motors_;  // of the board, each axis's second motor after all the first ones
  std::vector<std::uint32_t> lines_of_losses_;
  std::uint32_t fault_line_ = 0;  // of the following error beyond its limit
};

}  // namespace passo
