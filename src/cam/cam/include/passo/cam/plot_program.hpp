// write_plot_program: writes a plot as G-code, for a pen or a drag knife that Z or a servo lowers.
//
// With Z the pen travels at `up`, and draws at `down`. With a servo the program contains no Z: M3 with an S word lowers
// the pen, and M5, or M3 with another S word, raises it; the program pauses after each of them. Arcs are G2 and G3. The
// program begins and ends at the park position with the pen up, and ends with M2.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "passo/cam/plot_plan.hpp"
#include "passo/cam/program_units.hpp"

namespace passo {

struct PenServo {
  std::uint32_t down = 1000;             // S word that lowers the pen
  std::optional<std::uint32_t> up = {};  // S word that raises it; empty: M5 raises it
  double seconds = 0.2;                  // duration of its motion
};

struct PlotProgramOptions {
  std::string name = {};                  // program name, for the first comment
  std::vector<std::string> files = {};    // names of the drawing files
  std::vector<std::string> remarks = {};  // comments at the head of the program
  ProgramUnits units = ProgramUnits::mm;
  std::optional<PenServo> servo = {};  // empty: Z moves the pen
  Nanometres up{3'000'000};
  Nanometres down{};
  Nanometres feed{1'500'000'000};       // drawing feed, nm/min
  Nanometres plunge_feed{600'000'000};  // feed of the pen's descent, nm/min
  double dot_seconds = 0.1;             // how long the pen stays down at a dot
  DrawnPoint park = {};
};

// Returns the program text.
std::string write_plot_program(const PlotPlan& plan, const PlotProgramOptions& options);

}  // namespace passo
