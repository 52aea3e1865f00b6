// ToolChangePlan: what M6 does on a machine that measures its tools: where tools are changed and measured, how, and
// what the length found is used for. Without a plan, M6 only waits for the operator.
//
// Positions are machine coordinates, lengths millimetres. The data come from [tool_change] of the machine file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "passo/units/units.hpp"

namespace passo {

struct MachineXy {
  double x = 0;
  double y = 0;
  friend bool operator==(const MachineXy&, const MachineXy&) = default;
};

enum class ToolChangeWay : std::uint8_t {
  setter,  // by hand; a tool setter that stays on the machine
  plate,   // by hand; a touch plate that the operator puts under the tool
  rack,    // by the machine, from a rack of pockets
  macro,   // by lines of G-code, e.g. those of a tool changer
};

// The use of a length that was found.
enum class LengthUse : std::uint8_t {
  reference,  // the offset of G43 is the difference to the first tool, with which the work's Z was set
  absolute,   // the offset of G43 is the length from the spindle's nose: setter_z is where the nose would touch
  work,       // that difference moves the Z of the work coordinate systems, until the program ends
};

// What the first M6 of a program does.
enum class FirstTool : std::uint8_t {
  change,   // asks for the tool and measures it
  loaded,   // the tool is in the spindle: measures it
  trusted,  // the tool is in the spindle, and its length in the tool table is right
};

enum class ColletOutput : std::uint8_t { mist, flood };  // the output that opens the collet

struct ToolRack {
  std::int32_t pockets = 0;  // tool n is in pocket n; other tools are changed by hand
  MachineXy first;           // of pocket 1
  MachineXy step;            // from pocket to pocket
  double z = 0;              // machine Z at which the holder sits in its pocket
  MachineXy entry;           // from a pocket to the place beside it from which the tool goes in; 0, 0: from above
  MmPerSecond feed{0};
  ColletOutput opens = ColletOutput::mist;
  Seconds wait{0};  // until the collet has opened or closed
};

struct ToolChangePlan {
  ToolChangeWay way = ToolChangeWay::setter;
  double safe_z = 0;                    // height of all ways across
  std::optional<MachineXy> change_at;   // where the operator changes the tool; empty: where it was
  std::optional<MachineXy> measure_at;  // the setter; empty: over the work's X0 Y0, for a plate
  double window_low = 0;                // machine Z between which a tool touches
  double window_high = 0;
  MmPerSecond seek{0};
  MmPerSecond latch{0};
  double retract = 0;        // between the touches
  std::int32_t touches = 1;  // slow ones; their mean counts
  double agreement = 0.1;    // the largest difference between all touches of a measurement, the fast one included
  LengthUse use = LengthUse::reference;
  double setter_z = 0;  // for absolute lengths
  FirstTool first = FirstTool::change;
  Seconds run_down{0};         // of the spindle
  std::optional<double> wear;  // after use: the largest change of a tool's length; empty: not measured
  bool measures = true;        // false: only with a macro or a rack that needs no measuring
  ToolRack rack;
  std::string macro;  // lines, each with its end; without "O" and M99
  Seconds macro_collet_wait{1};
};

// From an output of the coolant to motion, if the output was switched off in the middle of a change, because it may
// open the collet: a door, a lost connection, a new host.
inline Seconds collet_wait(const ToolChangePlan& plan) {
  switch (plan.way) {
    case ToolChangeWay::rack: return plan.rack.wait;
    case ToolChangeWay::macro: return plan.macro_collet_wait;
    default: return Seconds(0);
  }
}

}  // namespace passo
