// GrblMachine: the properties that a Grbl 1.1 machine reports: its greeting, and the responses to $I, $$, $# and $G.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "passo/geometry/axes.hpp"
#include "passo/sender/grbl_firmware.hpp"

namespace passo {

struct GrblMachine {
  std::string firmware = "Grbl";                  // the name of a row of grbl_firmwares(), or what it calls itself
  std::string version = {};                       // "1.1h.20190830"; empty: no response to $I yet
  std::string axes = "XYZABCUVW";                 // letters of its axes in the order of its reports and settings
  std::size_t blocks = 15;                        // size of its planner queue
  std::size_t bytes = 128;                        // size of its receive buffer
  std::string options = {};                       // the letters of [OPT:…]
  std::string new_options = {};                   // grblHAL: "ENUMS,RT+,TC,SED"
  std::string kinematics = {};                    // if it tells any: "CoreXY"
  std::map<int, double> settings = {};            // the settings $0 … and their values
  std::map<int, std::string> setting_texts = {};  // the same, as the board writes them: "0.010"
  std::map<std::string, Point> offsets = {};      // mm: G54 … G59, G59.1 …, G28, G30, G92, TLO
  std::string system = "G54";                     // the active work coordinate system
  std::map<int, std::string> alarms = {};         // its own words for its alarms, if it tells them

  // Processes a response line: [VER:…], [OPT:…], [AXS:…], [FIRMWARE:…], [GC:…], [G54:…], $n=…. Ignores other lines.
  void hear(std::string_view line);
  // Processes the greeting.
  void hear_greeting(std::string_view line);
  // Processes the number of values in a report: a board that does not tell its axes has as many.
  void hear_value_count(std::size_t count);
  // Returns what it has said in [MSG:…] since the last call, at most 50 messages: "WARN: …", "ERR: …" of FluidNC.
  std::vector<std::string> take_messages() { return std::exchange(messages_, {}); }
  // Returns what to ask of the firmware, once, after it has told its version. The board may reject these lines.
  std::vector<std::string> take_questions();

  const GrblFirmware& row() const { return grbl_firmware(firmware); }
  // Returns whether its firmware is described. Otherwise it is treated as Grbl 1.1.
  bool is_known() const { return row().name == firmware; }
  // Returns whether M7 exists, as far as the board tells it.
  bool has_mist() const;
  // Returns whether it was built for a CoreXY: it plans the motion of the motors of X and Y.
  bool is_core_xy() const;
  // Returns whether F also applies to the way of these motors.
  bool measures_motors() const;
  // Returns whether [GC:…] may come that nobody has asked for.
  bool tells_modes_unasked() const;
  // Returns whether grblHAL has an option: "TC" (tool changes), "ATC", "SD" (files).
  bool has_option(std::string_view name) const;

  // Returns whether it knows $HX: Grbl and grblHAL tell it, FluidNC always does.
  bool homes_single_axes() const;

  bool in_inches() const;  // whether it reports in inches ($13)
  // Returns values of reports in mm and degrees.
  Point millimetres(Point reported) const;
  // Returns the work zero in machine coordinates, mm: the active work offset, G92 and the tool length. Empty: no
  // response to $# yet.
  std::optional<Point> work_zero() const;

 private:
  void hear_options(std::string_view options);
  void hear_modes(std::string_view modes);
  void hear_offset(std::string_view name, std::string_view value);
  void hear_setting(std::string_view line);
  void hear_axes(std::string_view value);
  void hear_alarm(std::string_view value);
  void become(std::string_view name);
  void note_sizes();

  bool has_told_axes_ = false;
  std::string asked_;           // the firmware whose questions were asked
  std::size_t told_bytes_ = 0;  // 0: not told yet
  std::vector<std::string> messages_;
};

// Returns the zero of G54 including G92, machine coordinates, mm and degrees.
Point first_work_zero(const GrblMachine& machine);

// Returns whether a line is the greeting of a starting machine: "Grbl 1.1h ['$' for help]".
bool is_grbl_greeting(std::string_view line);

}  // namespace passo
