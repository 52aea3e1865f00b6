// warnings_of(): warnings about the way in which a program uses a tool. Each warning has a stable code, its numbers,
// and advice that was checked: the advised use does not cause this warning, nor a new one.
//
//   tool.depth-over-flutes    the cut is deeper than the flute length
//   tool.holder               the holder touches the material
//   tool.step-over            neighbouring passes leave material between them
//   tool.chip-small           the teeth rub instead of cutting
//   tool.chip-large           a tooth cuts more than the tables permit
//   tool.plunge               a tool without teeth at its centre plunges
//   tool.spindle              the spindle speed is outside the range of the spindle or the tool
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "passo/tooling/cutting_feeds.hpp"
#include "passo/tooling/cutting_tool.hpp"

namespace passo {

// How a program uses a tool. Values of 0 are unknown and not checked.
struct ToolUse {
  double rpm = 0;
  MmPerSecond feed{0};
  Mm depth{0};  // of the deepest tip below the top of the material
  Mm depth_per_pass{0};
  Mm step_over{0};       // distance of neighbouring passes
  double width = 1;      // radial width of the cut as a fraction of the diameter, if the whole path keeps it
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
