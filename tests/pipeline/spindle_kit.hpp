// Threads, and where on the circumference their grooves are. Each step and the spindle's angle at that moment tell the
// place.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kit/driven.hpp"
#include "kit/example_machine.hpp"
#include <gtest/gtest.h>

namespace passo::test {

inline MachineDescription lathe(const SpindleDescription& spindle, bool jerk = false) {
  const MachineDescription router = example_machine("router");
  MachineDescription lathe = jerk ? with_jerk_limits(router) : router;
  lathe.spindle = spindle;
  return lathe;
}

inline const SpindleDescription ideal{.counts_per_turn = 4096};
inline const SpindleDescription rippling{
    .counts_per_turn = 4096, .run_up = Seconds(0.5), .droop = 0.03, .ripple = 0.05, .ripple_rate = Hertz(2)};

// Each step of Z in one direction, and the angle of the spindle, known to the machine and not to the controller, at
// that time.
struct Cut {
  double z = 0;
  double turns = 0;
};
class Thread final : public MachineObserver {
 public:
  Thread(const MachineDescription& description, const Plant& plant) : description_(description), plant_(plant) {}
  void on_steps(Ticks time, std::uint8_t stepped, std::uint8_t directions) override {
    const AxisDescription& z = description_.axes[2];
    if ((stepped & 4U) == 0) return;
    const bool down = ((directions & 4U) != 0) != z.inverted;
    place_ += down ? -1 : 1;
    if (down || both_ways) {
      const double seconds = static_cast<double>(time.count) / description_.board.clock.value();
      cuts.push_back({place_ / z.steps_per_unit, plant_.spindle().turns_at(Seconds(seconds))});
    }
  }
  std::vector<Cut> cuts;
  bool both_ways = false;

 private:
  const MachineDescription& description_;
  const Plant& plant_;
  double place_ = 0;
};

struct Played {
  std::vector<Cut> cuts;
  double time = 0;
  std::optional<LinkError> error = {};
  int rests = 0;  // rests because a refill came too late
  BoardOutputs outputs = {};
};
inline Played play(const std::string& program, const MachineDescription& machine, DriveOn options,
                   bool both_ways = false) {
  Diagnostics diagnostics;
  IdealPlant plant = plant_of(machine);
  options.plant = &plant;
  DrivenProgram job(ProgramReader::from_text("t", program), machine, InterpreterOptions(), diagnostics, options);
  Thread thread(machine, plant);
  thread.both_ways = both_ways;
  job.machine().add_observer(thread);
  while (job.advance()) {
  }
  EXPECT_FALSE(diagnostics.any_error()) << render(diagnostics, false);
  Played played{.cuts = thread.cuts, .time = job.drive().now().value(), .error = job.link().error()};
  if (job.drive().ledger() != nullptr) played.rests = job.drive().ledger()->recoveries();
  played.outputs = job.machine().counts().outputs;
  return played;
}

// Where on the circumference the groove is, for a cut: what is left of the turns when the thread's own are taken off.
inline double groove(const Cut& cut, double pitch) {
  return cut.turns + cut.z / pitch;
}

struct Spread {
  double low = 1e9;
  double high = -1e9;
  void see(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double mm(double pitch) const { return (high - low) * pitch; }
};
// Of one thread, between two depths.
inline Spread spread(const std::vector<Cut>& cuts, double pitch, double from, double to) {
  Spread all;
  for (const Cut& cut : cuts) {
    if (cut.z <= from && cut.z >= to) all.see(groove(cut, pitch));
  }
  return all;
}

// Of all passes, at one depth, where on the circumference the groove is: modulo whole turns.
inline std::vector<double> grooves_at(const std::vector<Cut>& cuts, double pitch, double z) {
  std::vector<double> passes;
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    if (cuts[i - 1].z > z && cuts[i].z <= z) passes.push_back(groove(cuts[i], pitch));
  }
  // The circumference has no beginning: what is near its seam is told from the first.
  for (double& pass : passes) pass -= std::round(pass - passes[0]);
  return passes;
}

inline std::string thread_program(const std::string& rpm) {
  return "G21 S" + rpm + " M3\nG33 Z-20 K1.5\nM5\nM2\n";
}

}  // namespace passo::test
