// GrblMachine: the properties that a Grbl 1.1 machine reports: its greeting, and the responses to $I, $$, $# and $G.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "passo/geometry/axes.hpp"

namespace passo {

struct GrblMachine {
  std::string firmware = "Grbl";              // or "grblHAL", "FluidNC"
  std::string version = {};                   // "1.1h.20190830"; empty: no response to $I yet
  std::string axes = "XYZABCUVW";             // axis letters of the numbers in its reports
  std::size_t blocks = 15;                    // size of its planner queue
  std::size_t bytes = 128;                    // size of its receive buffer
  std::map<int, double> settings = {};        // the settings $0 … and their values
  std::map<std::string, Point> offsets = {};  // mm: G54 … G59, G59.1 …, G28, G30, G92, TLO
  std::string system = "G54";                 // the active work coordinate system

  // Processes a response line: [VER:…], [OPT:…], [AXS:…], [FIRMWARE:…], [GC:…], [G54:…], $n=…. Ignores other lines.
  void hear(std::string_view line);
  // Processes the greeting.
  void hear_greeting(std::string_view line);

  bool in_inches() const;  // whether it reports in inches ($13)
  double unit() const { return in_inches() ? 25.4 : 1; }
  // Returns the work zero in machine coordinates, mm: the active work offset, G92 and the tool length. Empty: no
  // response to $# yet.
  std::optional<Point> work_zero() const;

 private:
  void hear_options(std::string_view options);
  void hear_modes(std::string_view modes);
  void hear_offset(std::string_view name, std::string_view value);
  void hear_setting(std::string_view line);
};

// Returns whether a line is the greeting of a starting machine: "Grbl 1.1h ['$' for help]".
bool is_grbl_greeting(std::string_view line);

}  // namespace passo
