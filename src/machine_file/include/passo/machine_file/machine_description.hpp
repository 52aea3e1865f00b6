// MachineDescription: what a machine file (TOML) says, checked and in strong units.
//
// The file is the only place where the parts of a real machine are written: its axes, its board, its tool. It is read
// once, before a job; the street takes its options from here. docs/manual/machine-file.md explains every key.
//
// Invariant: a description that was handed out is whole and sound. Every number is finite and in range, every
// axis can be played at its full velocity by the board and accelerates at every velocity, and there is at least one
// axis.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/geometry/axes.hpp"
#include "passo/machine_file/axis_motor.hpp"
#include "passo/units/units.hpp"

namespace passo {

inline constexpr std::size_t most_motors = 8;  // of a board; the same number as wire's max_motors

// How an axis is homed: by the limit switch at one of its ends.
struct HomeDescription {
  bool toward_high = false;
  double switch_at = 0;  // where it closes, machine coordinates
  MmPerSecond seek{0};
  MmPerSecond latch{0};  // slowly, for the place
  double pull_off = 0;   // so far off the switch the machine rests, and there it is open
  int input = -1;        // the board's limit switch; below 0 while it is not known that it is the motor's own

  double rest() const { return toward_high ? switch_at - pull_off : switch_at + pull_off; }
};

// A rotary axis has degrees in place of millimetres throughout.
struct AxisDescription {
  Axis axis = Axis::x;
  double steps_per_unit = 0;  // a millimetre, for a rotary axis a degree; always positive
  double travel_low = 0;      // machine coordinates
  double travel_high = 0;
  MmPerSecond velocity{0};
  MmPerSecond2 acceleration{0};    // never more than this; the motor may leave less
  std::optional<AxisMotor> motor;  // where the file tells it: acceleration follows its torque
  MmPerSecond3 jerk{0};            // 0: no limit
  bool inverted = false;           // the motor turns the other way
  std::optional<HomeDescription> home = {};

  MmPerSecond2 acceleration_at(MmPerSecond speed) const {
    return motor ? std::min(acceleration, motor->acceleration_at(speed)) : acceleration;
  }

  // The way of one step, and the steps a second at full velocity.
  Mm step() const { return Mm(1.0 / steps_per_unit); }
  Hertz highest_step_rate() const { return Hertz(velocity.value() * steps_per_unit); }
};

struct BoardDescription {
  Hertz clock{16e6};               // ticks a second
  Hertz highest_event_rate{50e3};  // events a second
  Seconds step_pulse{2.5e-6};
  int held_items = 240;  // places in its list, as the virtual machine plays it; a real board tells its own

  // An interval is at most 65535 whole ticks. Slower motion is played all the same: the events go on at this rate or
  // above, and most of them are without a step.
  Hertz lowest_event_rate() const { return Hertz(clock.value() / 65535); }
};

struct ToolDescription {
  std::string name;
  double highest_rpm = 0;  // 0: a relay, on or off
  Mm diameter{0};          // 0: not told
};

struct ProbeDescription {
  bool guards = false;  // touched in a move that is no probe move, it stops the machine
};

// What threads and feeds a revolution follow. The virtual machine's spindle also has a life of its own.
struct SpindleDescription {
  int counts_per_turn = 0;  // of its encoder; 0: none, and nothing follows it
  Seconds run_up{0};        // from rest to 1000 turns a minute
  double droop = 0;         // part of the speed that is missing under load
  double ripple = 0;        // part of the speed by which it goes up and down
  Hertz ripple_rate{1};
};

struct MachineDescription {
  std::string name;
  Mm path_tolerance{0.01};
  BoardDescription board;
  ToolDescription tool;
  ProbeDescription probe;
  SpindleDescription spindle;
  std::vector<AxisDescription> axes;  // in the order of the board's motors
  std::vector<Axis> homing = {};      // those that are homed, in that order
};

// Reads and checks a machine file. Everything that is wrong is in `diagnostics` (line, key, nearest key, what is
// missing), with codes "machine.*"; empty when there was any error.
std::optional<MachineDescription> load_machine_file(const std::string& path, Diagnostics& diagnostics);

// The same for a text that is in memory already. `file` names it in diagnostics.
std::optional<MachineDescription> parse_machine(std::string_view text, const std::string& file,
                                                Diagnostics& diagnostics);

// The description as a person reads it: one line for the machine, the board and the tool, one for each axis.
std::string describe(const MachineDescription& machine);

}  // namespace passo
