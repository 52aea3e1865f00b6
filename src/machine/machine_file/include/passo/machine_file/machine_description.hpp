// MachineDescription: the content of a machine file (TOML), checked and in strong units.
//
// Only this file describes the parts of a real machine: its axes, its board, its tool. It is read once, before a job,
// and the stages of the pipeline take their options from here. docs/manual/machine-file.md explains every key.
//
// Invariant: a description is complete and valid. Every number is finite and in range. The board can move every axis at
// its full velocity. Every axis has some acceleration at every velocity, and there is at least one axis.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/geometry/axes.hpp"
#include "passo/interpreter/program_hooks.hpp"
#include "passo/machine_file/axis_motor.hpp"
#include "passo/machine_file/handwheel_description.hpp"
#include "passo/motor/excitation.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct ToolChangePlan;
struct SpindleBusDescription;

inline constexpr std::size_t most_motors = 8;  // motors of one board; the same number as wire's max_motors

// How an axis is homed: by the limit switch at one of its ends.
struct HomeDescription {
  bool toward_high = false;
  double switch_at = 0;  // position at which the switch closes, machine coordinates
  MmPerSecond seek{0};
  MmPerSecond latch{0};      // slow speed of the second approach
  double pull_off = 0;       // distance from the switch at which the axis stops; the switch is open there
  int input = -1;            // the number of the board's limit switch; negative: not set yet, the motor's own switch
  double hysteresis = 0.05;  // of the simulated switch: the distance between closing and opening
  Seconds bounce{0};         // of the simulated switch: the duration of contact bounce after each change

  double rest() const { return toward_high ? switch_at - pull_off : switch_at + pull_off; }
};

// The known errors of an axis' screw. For a rotary axis, in degrees instead of millimetres.
struct ScrewDescription {
  struct Error {
    double at = 0;   // nominal position, machine coordinates
    double off = 0;  // true position minus nominal position
  };
  double backlash = 0;             // travel of the motor at a reversal before the axis moves
  std::vector<Error> errors = {};  // in ascending order of `at`
  bool is_compensated = true;      // false: only the simulated machine has these errors
};

// The encoder on the motor's shaft of an axis, and its use by the drive. Simulated motors with physics have such
// drives; a real drive is configured separately.
struct EncoderDescription {
  int counts_per_turn = 0;   // of the motor's shaft
  double most_error = 0;     // following error, mm or degrees, beyond which the machine stops. 0: no limit
  bool closes_loop = false;  // whether the drive corrects the rotor's position
};

// The second motor of an axis with two motors, e.g. a gantry. Homing squares the axis with two switches.
struct SecondMotor {
  bool inverted = false;  // true: this motor has the reversed direction
  int input = -1;         // the number of its limit switch; negative: not set yet, the motor's own switch
  double square = 0;      // correction of its position: how far its switch closes too early for a square axis
  double most_skew = 5;   // the largest correction of the skew in homing
  double skew = 0;        // in the simulated machine: the initial skew
};

// The board's inputs that a drive alarm can use: below 8 the pin of the limit switch with that number, then the
// buttons.
inline constexpr int alarm_at_feed_hold = 8;
inline constexpr int alarm_at_cycle_start = 9;

// For a rotary axis, all values are in degrees instead of millimetres.
struct AxisDescription {
  Axis axis = Axis::x;
  double steps_per_unit = 0;  // motor steps per millimetre (rotary axis: per degree); always positive
  double travel_low = 0;      // machine coordinates
  double travel_high = 0;
  MmPerSecond velocity{0};
  MmPerSecond2 acceleration{0};    // an upper limit; the motor's torque may reduce it
  std::optional<AxisMotor> motor;  // empty if the file does not describe the motor
  MmPerSecond3 jerk{0};            // 0: no limit
  MmPerSecond start_stop{0};       // the motor starts and stops at this velocity without a ramp; 0: always with a ramp
  bool inverted = false;           // true: the motor has the reversed direction
  // The radius of the cylinder that a rotary axis turns: the feed is the speed along its surface. Empty: degrees
  // count. 0: the distance of the tool from the rotation axis.
  std::optional<Mm> surface_radius = {};
  std::optional<HomeDescription> home = {};
  std::optional<ScrewDescription> screw = {};
  std::optional<SecondMotor> second = {};
  std::optional<EncoderDescription> encoder = {};
  std::optional<int> alarm_input = {};  // the input of its drive's alarm; several axes may share an input

  // The homing switches of the axis: bit i is switch i. Only for an axis with `home`.
  std::uint8_t home_switches() const {
    const unsigned own = 1U << static_cast<unsigned>(home->input);
    return static_cast<std::uint8_t>(own | (second ? 1U << static_cast<unsigned>(second->input) : 0U));
  }

  // Whether the acceleration follows the motor's torque.
  bool follows_torque() const { return motor && motor->limits_motion; }
  MmPerSecond2 acceleration_at(MmPerSecond speed) const {
    return follows_torque() ? std::min(acceleration, motor->acceleration_at(speed)) : acceleration;
  }

  // The length of one step, and the step rate at full velocity.
  Mm step() const { return Mm(1.0 / steps_per_unit); }
  Hertz highest_step_rate() const { return Hertz(velocity.value() * steps_per_unit); }
  // The step rate at the start-stop velocity.
  Hertz start_stop_rate() const { return Hertz(start_stop.value() * steps_per_unit); }
};

struct BoardDescription {
  Hertz clock{16e6};                        // timer frequency
  Hertz highest_event_rate{50e3};           // events/s
  Seconds step_pulse{2.5e-6};               // shortest time that the drivers need, like the next two
  Seconds direction_setup{0.65e-6};         // from a change of the direction to the next step
  Seconds direction_hold{0.65e-6};          // from the start of a step to a change of the direction
  int held_items = 240;                     // queue length of the simulated board; a real board reports its own
  std::optional<Excitation> windings = {};  // the board's pins switch the motors' windings; empty: drivers do
  bool held_items_are_given =
      false;  // true: `passo check` calculates the time cost of a link to a board with this queue length

  // An interval is at most 65535 whole ticks, so this is the lowest event rate. Slower motion is possible: most of its
  // events make no step.
  Hertz lowest_event_rate() const { return Hertz(clock.value() / 65535); }
};

struct ToolDescription {
  std::string name;
  double highest_rpm = 0;  // 0: the tool is switched by a relay
  Mm diameter{0};          // 0: not given
};

struct ProbeDescription {
  bool guards = false;  // true: a contact outside a probe move stops the machine
};

// The spindle that threads and feeds per revolution follow. Some keys describe the simulated spindle.
struct SpindleDescription {
  int counts_per_turn = 0;  // of its encoder; 0: no encoder, so nothing can follow the spindle
  Seconds run_up{0};        // from standstill to 1000 rpm; motion waits for it
  bool run_up_is_given = false;
  double droop = 0;   // speed drop under load, as a fraction
  double ripple = 0;  // amplitude of the speed variation, as a fraction
  Hertz ripple_rate{1};
  // The variable-frequency drive (VFD) that this computer controls by Modbus; null: the board switches the spindle.
  std::shared_ptr<const SpindleBusDescription> modbus = {};
};

// The silence of the host after which a stopped board switches its outputs off. Whole tenths of a second; 0: never.
struct SilenceDescription {
  Seconds spindle{2};
  Seconds mist{2};
  Seconds flood{2};
  Seconds spindle_wait{5};  // from the spindle's restart to motion, if the connection comes back
};

// The active levels of the board's pins that differ from the defaults: inputs are active low, outputs active high, and
// the drivers' enable active low.
struct PinsDescription {
  // True: active high, e.g. for a normally closed switch to ground.
  std::array<bool, most_motors> limits_high{};
  bool probe_high = false;
  bool door_high = false;
  bool emergency_stop_high = false;
  bool feed_hold_high = false;
  bool cycle_start_high = false;
  Seconds filter{100e-6};  // filter time: how long a switch must keep its new state, in whole microseconds
  bool driver_enable_high = false;
  // True: active low.
  bool step_low = false;
  bool spindle_low = false;
  bool spindle_reverse_low = false;
  bool mist_low = false;
  bool flood_low = false;
  Seconds drivers_off_after{0};  // stopped without a host, in whole tenths of a second; 0: never
  Seconds enable_wait{0};        // from the drivers' enable to motion
};

// A digital output of M62 to M65: the board's pin, which may also have another use.
struct DigitalOutputDescription {
  enum class Pin : std::uint8_t { flood, mist, direction };

  Pin pin = Pin::flood;
  bool stays_on = false;  // in holds and stop ramps
};

// A laser at the output of the spindle's speed.
struct LaserDescription {
  double maximum_s = 1000;
  double minimum = 0;  // the least power of an S above 0, as a fraction of full power
};

inline constexpr std::size_t most_digital_outputs_of_board = 3;

// The outputs that a program switches in motion.
struct MotionOutputsDescription {
  // By the number of M62 to M65. Empty: there is no such output.
  std::array<std::optional<DigitalOutputDescription>, most_digital_outputs_of_board> digital = {};
  std::optional<LaserDescription> laser = {};
};

// Where the tool is parked, and what it does at the end of a program (M2, M30).
struct ParkDescription {
  enum class AtEnd : std::uint8_t { stay, rise, park };

  std::optional<Point> place = {};  // X and Y in machine coordinates; empty: there is no park position
  AtEnd at_end = AtEnd::stay;
};

struct MachineDescription {
  std::string name;
  // X and Y share two motors of the same scale: one turns by X + Y, the other by X - Y. Only for boards with Grbl.
  bool is_core_xy = false;
  Mm path_tolerance{0.01};
  double path_tolerance_deg = 0.05;  // of rotary axes
  BoardDescription board;
  ToolDescription tool;
  ProbeDescription probe;
  SpindleDescription spindle;
  SilenceDescription silence;
  PinsDescription pins;
  ParkDescription park;
  MotionOutputsDescription motion_outputs;
  std::vector<AxisDescription> axes;   // in the order of the board's motors
  std::vector<Axis> homing = {};       // the axes that are homed, in the order of homing
  std::vector<int> homing_turns = {};  // group of each of them: axes with the same number seek their switches together
  std::shared_ptr<const ToolChangePlan> tool_change = {};  // what M6 does; null: it waits for the operator
  ProgramHooks hooks = {};
  std::optional<HandwheelDescription> handwheel = {};

  bool has_rotary_axis() const {
    return std::ranges::any_of(axes, [](const AxisDescription& axis) { return is_rotary(axis.axis); });
  }
  // The highest Z for moves above everything: the end of the travel, or the position after homing if that is lower.
  // Empty: the machine has no Z axis.
  std::optional<double> top_of_travel() const {
    const auto z = std::ranges::find(axes, Axis::z, &AxisDescription::axis);
    if (z == axes.end()) return {};
    return z->home && z->home->toward_high ? std::min(z->travel_high, z->home->rest()) : z->travel_high;
  }
  // The motors of the board: one for each axis, then the second motors in the order of their axes.
  std::uint8_t motor_count() const {
    return static_cast<std::uint8_t>(axes.size() +
                                     static_cast<std::size_t>(std::ranges::count_if(
                                         axes, [](const AxisDescription& axis) { return axis.second.has_value(); })));
  }
  // The number of the second motor of axis `index`. Only for an axis that has one.
  std::uint8_t second_motor_of(std::size_t index) const {
    std::size_t motor = axes.size();
    for (std::size_t i = 0; i < index; ++i) motor += axes[i].second ? 1 : 0;
    return static_cast<std::uint8_t>(motor);
  }
};

// The bytes of a machine file, cut off slightly above the allowed size. Empty, with a diagnostic: the file cannot be
// read.
std::optional<std::string> machine_file_text(const std::string& path, Diagnostics& diagnostics);

// What the caller does with a machine. Whoever plans or makes the steps of its motors cannot use a machine that only a
// board with Grbl drives: that is an error of the file then.
enum class MachineUse : std::uint8_t { own_board, any_board };

// Reads and checks a machine file. All errors go to `diagnostics` (line, key, nearest key, what is missing), with codes
// "machine.*". Returns nothing if there was any error.
std::optional<MachineDescription> load_machine_file(const std::string& path, Diagnostics& diagnostics,
                                                    MachineUse use = MachineUse::own_board);

// The same for a text in memory. `file` names the text in diagnostics.
std::optional<MachineDescription> parse_machine(std::string_view text, const std::string& file,
                                                Diagnostics& diagnostics, MachineUse use = MachineUse::own_board);

// The description as readable text: one line each for the machine, the board and the tool, and one for each axis.
std::string describe(const MachineDescription& machine);

}  // namespace passo
