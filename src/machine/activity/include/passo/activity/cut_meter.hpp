// CutMeter: how far and how long each tool cuts: feed moves while the spindle turns. Rapids, probe moves and moves that
// only take up backlash do not count.
//
// Position in the pipeline: an observer, of executed motion for the life of tools, and of a path for a forecast. It
// counts what it sees: after a stop, a motion that is planned again is seen only once it is executed.
//
// Invariant: the length is that of the path, so it does not depend on speeds. cut_between() (journal/) finds the same
// length without a run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>

#include "passo/path/segment.hpp"
#include "passo/trajectory/phase.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct CutAmount {
  Mm length{0};
  Seconds time{0};
  CutAmount& operator+=(const CutAmount& other) {
    length += other.length;
    time += other.time;
    return *this;
  }
  friend bool operator==(const CutAmount&, const CutAmount&) = default;
};
// By the number of the tool. What is cut before the program names a tool is not counted.
using CutAmounts = std::map<std::int32_t, CutAmount>;

class CutMeter {
 public:
  CutMeter() = default;
  // For motion that begins in the middle of a path. `lead_in`: the number of path items that lead there, which do not
  // count.
  CutMeter(std::int32_t tool, const OutputState& outputs, std::size_t lead_in)
      : tool_(tool), outputs_(outputs), lead_in_(lead_in) {}

  void watch(const MotionItem& motion);
  // `share`: the part of a segment that counts. `time`: of the whole segment.
  void watch(const PathItem& item, Seconds time, double share = 1);

  const CutAmounts& amounts() const { return amounts_; }
  std::int32_t tool() const { return tool_; }

 private:
  void follow(const Action& action);
  void add(const Segment& segment, Mm length, Seconds time);

  CutAmounts amounts_;
  std::int32_t tool_ = 0;
  OutputState outputs_;
  std::size_t lead_in_ = 0;
  bool probes_ = false;
};

}  // namespace passo
