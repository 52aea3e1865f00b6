// The machine of the fuzzers that run a whole session: small, with few steps, so that much happens in little time. Does
// not use GoogleTest, which libFuzzer does not provide.
#pragma once

#include <cstdio>
#include <cstdlib>

#include "passo/activity/machine_plant.hpp"
#include "passo/machine/virtual_machine.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/session/board_machine_session.hpp"

namespace passo::test {

inline constexpr const char* fuzzed_machine_text = R"toml(name = "Fuzzed"
[board]
clock_hz = 16_000_000
max_event_rate_hz = 20_000
[homing]
order = "Z (XY)"
[axis.X]
steps_per_mm = 10
travel_mm = [-50, 50]
max_velocity_mm_s = 100
max_acceleration_mm_s2 = 800
[axis.X.home]
direction = "low"
switch_at_mm = -51
seek_mm_s = 50
latch_mm_s = 5
pull_off_mm = 2
[axis.Y]
steps_per_mm = 10
travel_mm = [-30, 30]
max_velocity_mm_s = 100
max_acceleration_mm_s2 = 800
[axis.Y.home]
direction = "low"
switch_at_mm = -31
seek_mm_s = 50
latch_mm_s = 5
pull_off_mm = 2
[axis.Z]
steps_per_mm = 20
travel_mm = [-40, 10]
max_velocity_mm_s = 50
max_acceleration_mm_s2 = 500
[axis.Z.home]
direction = "high"
switch_at_mm = 11
seek_mm_s = 50
latch_mm_s = 5
pull_off_mm = 2
)toml";

// Reports a failure so that libFuzzer detects it.
inline void require(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "%s\n", what);
  std::abort();
}

inline const MachineDescription& fuzzed_machine() {
  static const MachineDescription machine = [] {
    Diagnostics diagnostics;
    const auto read = parse_machine(fuzzed_machine_text, "fuzzed.toml", diagnostics);
    std::fprintf(stderr, "%s", render(diagnostics, false).c_str());
    require(read.has_value(), "the machine of the fuzzer is not sound");
    return *read;
  }();
  return machine;
}

// A session with a virtual machine at machine zero.
class FuzzedSession {
 public:
  explicit FuzzedSession(Trust trust)
      : session(fuzzed_machine(), board_, {.tells_place = true, .start = {.place = Point(), .trust = trust}}) {
    fit(plant_, fuzzed_machine());
    board_.connect(plant_);
    board_.wire(pin_setup(fuzzed_machine()));
  }

 private:
  VirtualMachine board_{fuzzed_machine().motor_count(), fuzzed_machine().board.clock,
                        fuzzed_machine().board.highest_event_rate,
                        static_cast<std::size_t>(fuzzed_machine().board.held_items)};
  IdealPlant plant_;

 public:
  BoardMachineSession session;
};

}  // namespace passo::test
