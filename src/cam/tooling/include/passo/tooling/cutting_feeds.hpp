// feeds_of(): spindle speed, feed, plunge feed, depth of a pass and stepover of a tool in a material, each with its
// reason, from the published tables of chip_tables.hpp.
//
// The feed is chip load × flutes × rpm. The chip load is the lower end of the table's range for the material and the
// diameter, or the tool's own chip load. If the machine cannot feed that fast, the spindle turns more slowly; if the
// spindle cannot, the chip becomes thinner. The numbers are meant for a first test cut.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/tooling/cutting_tool.hpp"
#include "passo/units/units.hpp"

namespace passo {

// The speeds that a spindle can turn. 0: unknown, without limit.
struct SpindleRange {
  double least_rpm = 0;
  double most_rpm = 0;
};

struct FeedRequest {
  WorkMaterial material = WorkMaterial::plywood;
  SpindleRange spindle = {};
  MmPerSecond most_feed{0};    // the machine's highest feed in X and Y; 0: unknown
  MmPerSecond most_plunge{0};  // its highest feed in Z; 0: unknown
  Mm depth{0};                 // depth of a pass; 0: from the tables. Deeper passes have thinner chips
  // Radial width of the cut as a share of the diameter, above 0, at most 1. Below a half the feed is raised, because
  // the chip becomes thinner than the feed per tooth. Set it only if the whole path keeps it (adaptive clearing).
  double width = 1;
  std::optional<double> rpm = {};  // chosen spindle speed, within the limits of spindle and tool
};

struct FeedReason {
  std::string_view of;      // "spindle", "chip load", "feed", "plunge", "depth", "stepover"
  std::string text;         // "0.076 mm per tooth for 3.175 mm in softwood"
  std::string_view source;  // address of the page with the table; empty: arithmetic
};

// What a tooth may cut, mm per tooth.
struct ChipRange {
  Mm least{0};
  Mm most{0};
};

struct CuttingFeeds {
  double rpm = 0;  // a multiple of 10
  MmPerSecond feed{0};
  MmPerSecond plunge{0};  // 0: the tool must not plunge
  Mm depth_per_pass{0};   // 0: not limited by a table (drills)
  double step_over = 0;   // share of the diameter; 0: none (drills)
  Mm chip_load{0};        // of these feeds, mm per tooth
  ChipRange chip_range = {};
  std::vector<FeedReason> reasons = {};
};

// `request.width` outside its range counts as 1. Every result is finite, and above 0 unless stated otherwise.
CuttingFeeds feeds_of(const CuttingTool& tool, const FeedRequest& request);

// Returns the thickest chip as a share of the feed per tooth, for a cut of this radial width (a share of the diameter):
// 1 from half the diameter on, at least 0.1.
double chip_thinning(double width);

// Returns the range of chip loads for this tool in this material at this depth of a pass (0: at most the diameter).
ChipRange chip_range_of(const CuttingTool& tool, WorkMaterial material, Mm depth);

}  // namespace passo
