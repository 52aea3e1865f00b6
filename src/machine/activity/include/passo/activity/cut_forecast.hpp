// CutForecast: what a program will cut with each tool, and the lines at which tools reach the end of their lives.
//
// Position in the pipeline: an observer of the path of a check. Its times are those at the programmed feeds.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "passo/activity/cut_meter.hpp"
#include "passo/diagnostics/diagnostic.hpp"
#include "passo/trajectory/motion_limits.hpp"

namespace passo {

// What is left of the life of a tool, whichever ends first. Negative: it has ended already.
struct LifeLeft {
  std::optional<Mm> length = {};
  std::optional<Seconds> time = {};
};
using LivesLeft = std::map<std::int32_t, LifeLeft>;

class CutForecast {
 public:
  CutForecast(const MotionLimits& limits, LivesLeft left) : limits_(limits), left_(std::move(left)) {}

  void add(const PathItem& item);
  const CutAmounts& amounts() const { return meter_.amounts(); }
  // Adds a warning [tool.life-ends] for each tool whose life the program exceeds, with the line and by how much.
  void add_findings(const std::string& file, Diagnostics& findings) const;

 private:
  MotionLimits limits_;
  LivesLeft left_;
  CutMeter meter_;
  std::map<std::int32_t, std::uint32_t> ends_at_;  // lines, by tool
};

}  // namespace passo
