// ProbingCycle: a ready-made program that probes a surface, an edge, a corner, the centre of a bore or a boss, a tool's
// length, the angle of the workpiece, the position and angle of the workpiece from two bores, or the heights of a
// surface.
//
// A cycle is G-code (RS274/NGC in LinuxCNC's dialect) like any other program: it is checked, shown and run in the same
// way. It writes its result by G10, so the result is the program's offsets. Each point is touched twice, first fast and
// then slowly; a height map touches each point once. The sequence of each cycle is described in docs/manual/probing.md,
// and in the comments at the head of its program.
//
// Lengths are millimetres, speeds mm/min. A value out of its range is refused with a sentence.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "passo/base/result.hpp"

namespace passo {

enum class ProbingKind : std::uint8_t { surface, edge, corner, bore, boss, tool, angle, bores, map };

struct ProbingCycle {
  // Each point is touched twice; a height map touches each point once, with `fast`.
  struct Touch {
    double reach = 25;  // maximum probing distance
    double fast = 300;  // speed of the first touch
    double slow = 30;   // speed of the second touch
    double back = 1;    // retract distance between the two touches
  };
  // The parameters for measuring a tool.
  struct MeasuredTool {
    double number = 1;
    double travel_z = 0;  // safe machine Z for travel
    double zero_z = 0;    // machine Z at which a tool of length 0 triggers the probe
  };

  ProbingKind kind = ProbingKind::surface;
  // For an edge and an angle: the direction of the touch, "x+", "x-", "y+" or "y-". For a corner: which one, e.g.
  // "front-left"; front is towards Y-, left towards X-.
  std::string side = {};
  double system = 1;  // the work coordinate system to be set: 1 is G54, 9 is G59.3
  double ball = 0;    // diameter of the probe tip's ball
  Touch touch = {};
  double clearance = 5;  // retract distance after a touch
  double depth = 3;      // depth of the side touches below the top; for a map: probing depth below zero
  double height = 0;     // for a surface: work Z of the touched surface, e.g. the thickness of a touch plate
  double inside = 10;    // for a corner: distance from the corner along the first side at which the second side is
                         // touched
  double size_x = 20;    // for a boss: its approximate width; for a map: the width of the grid
  double size_y = 20;
  double along = 20;  // for an angle: distance between the two touches
  // For a map: its lower left corner in work coordinates; for a tool: the probe's position in machine coordinates; for
  // bores: the programmed position of the first one.
  double x = 0;
  double y = 0;
  double second_x = 50;  // programmed position of the second bore
  double second_y = 0;
  double fit = 0.3;    // tolerance of the distance between the bores
  double columns = 5;  // number of grid columns, for a map
  double rows = 5;
  MeasuredTool tool = {};
};

// A numeric parameter of a cycle, for command lines, APIs and their checks.
struct ProbingField {
  std::string_view name;
  double& (*value)(ProbingCycle& cycle) = nullptr;
  double low = 0;
  double high = 0;
  bool is_whole = false;
  std::uint32_t kinds = 0;  // the cycles that use it: bits by ProbingKind
  std::string_view words = {};

  constexpr bool is_of(ProbingKind kind) const { return (kinds >> static_cast<unsigned>(kind) & 1U) != 0; }
};
std::span<const ProbingField> probing_fields();

std::string_view name_of(ProbingKind kind);
// Returns what the cycle finds, as a clause.
std::string_view purpose_of(ProbingKind kind);
std::span<const ProbingKind> all_probing_kinds();

// Returns the cycle as a program. The error is a sentence without a full stop.
Result<std::string, std::string> probing_program(const ProbingCycle& cycle);

}  // namespace passo
