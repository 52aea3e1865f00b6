// What a machine that speaks Grbl 1.1 tells of itself: its greeting, and the answers to $I, $$, $# and $G.
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
  std::string version = {};                   // "1.1h.20190830"; empty: it has not answered $I
  std::string axes = "XYZABCUVW";             // the letters of the numbers in its reports
  std::size_t blocks = 15;                    // of its planner
  std::size_t bytes = 128;                    // of its receive buffer
  std::map<int, double> settings = {};        // $0 …
  std::map<std::string, Point> offsets = {};  // mm: G54 … G59, G92, TLO
  std::string system = "G54";                 // in force

  // Takes a line of its answers: [VER:…], [OPT:…], [AXS:…], [FIRMWARE:…], [GC:…], [G54:…], $n=…. Other lines tell
  // nothing of it.
  void hear(std::string_view line);
  // Takes its greeting.
  void hear_greeting(std::string_view line);

  bool in_inches() const;  // its reports are in inches ($13)
  double unit() const { return in_inches() ? 25.4 : 1; }
  // Where the zero of the work lies, machine coordinates, mm: the system in force, G92 and the tool's length. Empty: it
  // has not answered $#.
  std::optional<Point> work_zero() const;

 private:
  void hear_options(std::string_view options);
  void hear_modes(std::string_view modes);
  void hear_offset(std::string_view name, std::string_view value);
  void hear_setting(std::string_view line);
};

// Whether a line is what a machine says when it starts: "Grbl 1.1h ['$' for help]".
bool is_grbl_greeting(std::string_view line);

}  // namespace passo
