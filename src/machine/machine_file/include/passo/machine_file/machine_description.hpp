// MachineDescription: the content of a machine file (TOML), checked and in strong units.
//
// Only this file describes the parts of a real machine: its axes, its board, its tool. It is read once, before a job,
// and the stages of the street take their options from here. docs/manual/machine-file.md explains every key.
//
// Invariant: a description that was handed out is whole and sound. Every number is finite and in range. The board can
// play every axis at its full velocity. Every axis accelerates at every velocity, and there is at least one axis.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/geometry/axes.hpp"
#include "passo/machine_file/axis_motor.hpp"
#include "passo/motor/excitation.hpp"
#include "passo/units/units.hpp"

namespace passo {

inline constexpr std::size_t most_motors = 8;  // motors of one board; the same number as wire's max_motors

// How an axis is homed: by the limit switch at one of its ends.
struct HomeDescription {
  bool toward_high = false;
  double switch_at = 0;  // where the switch closes, machine coordinates
  MmPerSecond seek{0};
  MmPerSecond latch{0};      // slow, to find the exact place
  double pull_off = 0;       // distance from the switch at which the machine rests; the switch is open there
  int input = -1;            // the number of the board's limit switch; below 0: not known yet, the motor's own is meant
  double hysteresis = 0.05;  // of the virtual machine's switch: how much further off it opens than it closes
  Seconds bounce{0};         // for how long the virtual machine's contact opens and closes after each change

  double rest() const { return toward_high ? switch_at - pull_off : switch_at + pull_off; }
};

// What the screw of an axis is known to do wrong. A rotary axis has degrees for millimetres.
struct ScrewDescription {
  struct Error {
    double at = 0;   // place by the screw's nominal pitch, machine coordinates
    double off = 0;  // true place minus that place
  };
  double backlash = 0;             // what the motor turns at a reversal before the axis moves
  std::vector<Error> errors = {};  // in ascending order of `at`
  bool is_compensated = true;      // false: only the virtual machine behaves so
};

// The encoder on the motor's shaft of an axis, and what the axis's drive does with it. The virtual machine's motors
// with physics have such drives; a real drive is set up by itself.
struct EncoderDescription {
  int counts_per_turn = 0;   // of the motor's shaft
  double most_error = 0;     // from the commanded place, mm or degrees; beyond it the machine stops. 0: no limit
  bool closes_loop = false;  // the drive brings the rotor back
};

// The second motor of an axis that two motors turn together, as at a gantry. Homing squares the axis by two switches.
struct SecondMotor {
  bool inverted = false;  // true: this motor turns the other way
  int input = -1;         // the number of its limit switch; below 0: not known yet, the motor's own is meant
  double square = 0;      // added to its place: how far its switch closes too early for a square axis
  double most_skew = 5;   // homing moves this motor no further than that against the other
  double skew = 0;        // in the virtual machine: how far it is ahead of the other at first
};

// For a rotary axis degrees take the place of millimetres throughout.
// The inputs of a board at which a drive may give its alarm: below 8 the pin of that limit switch, then those of
// buttons.
inline constexpr int alarm_at_feed_hold = 8;
inline constexpr int alarm_at_cycle_start = 9;

struct AxisDescription {
  Axis axis = Axis::x;
  double steps_per_unit = 0;  // motor steps a millimetre (rotary axis: a degree); always positive
  double travel_low = 0;      // machine coordinates
  double travel_high = 0;
  MmPerSecond velocity{0};
  MmPerSecond2 acceleration{0};    // an upper limit; the motor may leave less
  std::optional<AxisMotor> motor;  // the motor, where the file describes it
  MmPerSecond3 jerk{0};            // 0: no limit
  MmPerSecond start_stop{0};       // the motor starts and stops at it in one step; 0: always from rest
  bool inverted = false;           // true: the motor turns the other way
  std::optional<HomeDescription> home = {};
  std::optional<ScrewDescription> screw = {};
  std::optional<SecondMotor> second = {};
  std::optional<EncoderDescription> encoder = {};
  std::optional<int> alarm_input = {};  // where its drive gives its alarm; several axes may share an input

  // The limit switches by which the axis is homed: bit i is switch i. Only for an axis with `home`.
  std::uint8_t home_switches() const {
    const unsigned own = 1U << static_cast<unsigned>(home->input);
    return static_cast<std::uint8_t>(own | (second ? 1U << static_cast<unsigned>(second->input) : 0U));
  }

  // Whether the acceleration follows the motor's torque.
  bool follows_torque() const { return motor && motor->limits_motion; }
  MmPerSecond2 acceleration_at(MmPerSecond speed) const {
    return follows_torque() ? std::min(acceleration, motor->acceleration_at(speed)) : acceleration;
  }

  // The length of one step, and the steps a second at full velocity.
  Mm step() const { return Mm(1.0 / steps_per_unit); }
  Hertz highest_step_rate() const { return Hertz(velocity.value() * steps_per_unit); }
  // The motor's pull-in rate, as far as it is used: steps a second.
  Hertz start_stop_rate() const { return Hertz(start_stop.value() * steps_per_unit); }
};

struct BoardDescription {
  Hertz clock{16e6};                 // ticks a second
  Hertz highest_event_rate{50e3};    // events a second
  Seconds step_pulse{2.5e-6};        // the least that the drivers need, as the next two
  Seconds direction_setup{0.65e-6};  // from a change of the direction to the next step
  Seconds direction_hold{0.65e-6};   // from a step's beginning to a change of the direction
  int held_items = 240;              // places in the list of the virtual board; a real board tells its own number
  std::optional<Excitation> windings = {};  // the board's own pins switch the motors' windings; empty: drivers do
  bool held_items_are_given = false;        // true: `passo check` says what a line to a board with so many places costs

  // An interval is at most 65535 whole ticks, so events never come slower than this. Slower motion is possible: most of
  // its events make no step.
  Hertz lowest_event_rate() const { return Hertz(clock.value() / 65535); }
};

struct ToolDescription {
  std::string name;
  double highest_rpm = 0;  // 0: a relay, on or off
  Mm diameter{0};          // 0: not given
};

struct ProbeDescription {
  bool guards = false;  // true: a contact outside a probe move stops the machine
};

// The spindle that threads and feeds a revolution follow. Some keys describe how the virtual machine's spindle behaves.
struct SpindleDescription {
  int counts_per_turn = 0;  // of its encoder; 0: no encoder, and nothing can follow the spindle
  Seconds run_up{0};        // from rest to 1000 turns a minute; motion waits for it
  bool run_up_is_given = false;
  double droop = 0;   // the share of the speed that is missing under load
  double ripple = 0;  // the share of the speed by which it goes up and down
  Hertz ripple_rate{1};
};

// After what silence of the host a board, at rest, switches its outputs off. Whole tenths of a second; 0: never.
struct SilenceDescription {
  Seconds spindle{2};
  Seconds mist{2};
  Seconds flood{2};
  Seconds spindle_wait{5};  // from the spindle's second start to motion, if the line comes back
};

// The levels of the board's pins, where they are not the usual ones: an input is on when it is low, an output when it
// is high, and the drivers' enable when it is low.
struct PinsDescription {
  // True: on when the pin is high, as with a normally closed switch to ground.
  std::array<bool, most_motors> limits_high{};
  bool probe_high = false;
  bool door_high = false;
  bool emergency_stop_high = false;
  bool feed_hold_high = false;
  bool cycle_start_high = false;
  Seconds filter{
      100e-6};  // for so long a switch must have kept its new state before that counts, in whole microseconds
  bool driver_enable_high = false;
  // True: on when the pin is low.
  bool step_low = false;
  bool spindle_low = false;
  bool spindle_reverse_low = false;
  bool mist_low = false;
  bool flood_low = false;
  Seconds drivers_off_after{0};  // at rest without a host, in whole tenths of a second; 0: never
  Seconds enable_wait{0};        // from the drivers' enable to motion
};

struct MachineDescription {
  std::string name;
  Mm path_tolerance{0.01};
  BoardDescription board;
  ToolDescription tool;
  ProbeDescription probe;
  SpindleDescription spindle;
  SilenceDescription silence;
  PinsDescription pins;
  std::vector<AxisDescription> axes;   // in the order of the board's motors
  std::vector<Axis> homing = {};       // the axes that are homed, in the order of homing
  std::vector<int> homing_turns = {};  // of each of them: axes with the same number seek their switches at once

  // The motors of the board: one for each axis, then the second motors in the order of their axes.
  std::uint8_t motor_count() const {
    return static_cast<std::uint8_t>(axes.size() +
                                     static_cast<std::size_t>(std::ranges::count_if(
                                         axes, [](const AxisDescription& axis) { return axis.second.has_value(); })));
  }
  // The board's motor that is the second one of axis `index`. Only for an axis that has one.
  std::uint8_t second_motor_of(std::size_t index) const {
    std::size_t motor = axes.size();
    for (std::size_t i = 0; i < index; ++i) motor += axes[i].second ? 1 : 0;
    return static_cast<std::uint8_t>(motor);
  }
};

// The bytes of a machine file, at most a little more than it may have. Empty, with a diagnostic: it cannot be read.
std::optional<std::string> machine_file_text(const std::string& path, Diagnostics& diagnostics);

// Reads and checks a machine file. All errors go to `diagnostics` (line, key, nearest key, what is missing), with codes
// "machine.*". Returns nothing if there was any error.
std::optional<MachineDescription> load_machine_file(const std::string& path, Diagnostics& diagnostics);

// The same for a text in memory. `file` names the text in diagnostics.
std::optional<MachineDescription> parse_machine(std::string_view text, const std::string& file,
                                                Diagnostics& diagnostics);

// The description for a person to read: one line for the machine, the board and the tool, and one for each axis.
std::string describe(const MachineDescription& machine);

}  // namespace passo
