// warnings_of(): what is wrong with the way in which a program uses a tool. Each warning has a stable code, its
// numbers, and advice that was tried: with the advised use, this warning is gone, and no other one has come.
//
//   tool.depth-over-flutes    the cut is deeper than the cutting edges are long
//   tool.holder               the holder comes down to the material
//   tool.step-over            neighbouring passes leave material between them
//   tool.chip-small           the teeth rub instead of cutting
//   tool.chip-large           a tooth takes more than the tables permit
//   tool.plunge               a tool without teeth at its centre descends straight
//   tool.spindle              a spindle speed outside the range of spindle or tool
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "passo/tooling/cutting_feeds.hpp"
#include "passo/tooling/cutting_tool.hpp"

namespace passo {

// How a program uses a tool. What is 0 is unknown and not checked.
struct ToolUse {
  double rpm = 0;
  MmPerSecond feed{0};
  Mm depth{0};  // of the deepest tip below the top of the material
  Mm depth_per_pass{0};
  Mm step_over{0};       // distance of neighbouring passes
  double width = 1;      // radial width of the cut as a share of the diameter, where the whole path keeps it
  bool plunges = false;  // descends straight down in the material
};

struct ToolWarning {
  std::string code;     // "tool.chip-small"
  std::string message;  // "T2 cuts 0.008 mm per tooth: below 0.023 mm the teeth rub"
  std::string advice;   // "a feed of 1,080 mm/min, or a spindle speed of 2,000 rpm"
  double found = 0;     // the two numbers of the message, in the unit of `unit`
  double limit = 0;
  const char* unit = "mm";  // "mm", "mm per tooth", "rpm"; "" for a plunge
  ToolUse advised = {};     // the use with the advice
};

// `material`: empty: chip loads are not checked. `spindle`, `most_feed`: of the machine, 0 where unknown.
std::vector<ToolWarning> warnings_of(const CuttingTool& tool, const ToolUse& use, std::optional<WorkMaterial> material,
                                     const SpindleRange& spindle = {}, MmPerSecond most_feed = MmPerSecond(0));

}  // namespace passo
