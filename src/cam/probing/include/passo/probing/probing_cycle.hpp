// ProbingCycle: a ready program that finds a place with the probe: a surface, an edge, a corner, the middle of a bore
// or of a boss, a tool's length, the angle of the work, two bores that tell place and angle, the heights of a surface.
//
// A cycle is G-code (RS274/NGC in LinuxCNC's dialect) like any other program: it is checked, shown and run in the same
// way, and what it finds it writes by G10, so the offsets are the program's result. Each touch is made twice, fast and
// slowly; the heights of a surface are touched once a place. The sequence of each cycle stands in
// docs/manual/probing.md, and in the comments at the head of its program.
//
// Lengths are millimetres, speeds mm/min. Every value has a range; what is out of it is refused in a sentence.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "passo/base/result.hpp"

namespace passo {

enum class ProbingKind : std::uint8_t { surface, edge, corner, bore, boss, tool, angle, bores, map };

struct ProbingCycle {
  // Each touch is made twice. A map touches once a place, with `fast`.
  struct Touch {
    double reach = 25;  // how far it looks
    double fast = 300;  // speed of the first touch
    double slow = 30;   // speed of the second touch
    double back = 1;    // between the two touches
  };
  // Of a tool that is measured.
  struct MeasuredTool {
    double number = 1;
    double travel_z = 0;  // the machine's Z at which nothing is in the way
    double zero_z = 0;    // the machine's Z at which a tool of length 0 touches
  };

  ProbingKind kind = ProbingKind::surface;
  // Of an edge and of an angle: the way of the touch, "x+", "x-", "y+" or "y-". Of a corner: which, as "front-left";
  // front is towards Y-, left towards X-.
  std::string side = {};
  double system = 1;  // the work system that gets what is found: 1 is G54, 9 is G59.3
  double ball = 0;    // diameter of the probe's ball
  Touch touch = {};
  double clearance = 5;  // how far the probe goes off what it has touched
  double depth = 3;      // how far below the top the sides are touched; of a map: how far below the zero it looks
  double height = 0;     // of a surface: the work's Z of what is touched, as the thickness of a plate
  double inside = 10;    // of a corner: how far from it along the first side the second one is touched
  double size_x = 20;    // of a boss: its width, roughly; of a map: the width of the grid
  double size_y = 20;
  double along = 20;  // of an angle: between the two touches
  // Of a map: its lower left corner, work coordinates; of a tool: the probe's place in the machine; of bores: where the
  // program has the first one.
  double x = 0;
  double y = 0;
  double second_x = 50;  // where the program has the second bore
  double second_y = 0;
  double fit = 0.3;    // how much nearer or farther apart the bores may be than in the program
  double columns = 5;  // of a map
  double rows = 5;
  MeasuredTool tool = {};
};

// What can be said of a cycle by a number: for command lines, APIs and their checks.
struct ProbingField {
  std::string_view name;
  double& (*value)(ProbingCycle& cycle) = nullptr;
  double low = 0;
  double high = 0;
  bool is_whole = false;
  std::uint32_t kinds = 0;  // of the cycles that know it: bits by ProbingKind
  std::string_view words = {};

  constexpr bool is_of(ProbingKind kind) const { return (kinds >> static_cast<unsigned>(kind) & 1U) != 0; }
};
std::span<const ProbingField> probing_fields();

std::string_view name_of(ProbingKind kind);
// What the cycle finds: a clause.
std::string_view purpose_of(ProbingKind kind);
std::span<const ProbingKind> all_probing_kinds();

// The cycle as a program. The error is a sentence without a full stop.
Result<std::string, std::string> probing_program(const ProbingCycle& cycle);

}  // namespace passo
