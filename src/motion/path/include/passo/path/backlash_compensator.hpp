// BacklashCompensator: takes up the backlash of an axis wherever the path reverses the axis.
//
// Position in the pipeline: before the planner. Segments are cut where an axis with backlash reverses. There, the path
// stops, and an extra segment moves only the motor of that axis, within the limits of the axis, until the backlash is
// taken up. The tool does not move during that time, so it stays on the path, to the step. Each segment records on
// which side the backlash of each axis is (Segment::downs), so that motion can be followed from any point of a segment.
// See docs/decisions/0083-backlash-is-taken-up-at-rest.md.
//
// A path begins and ends with all backlash taken up for motion in the positive direction, so the step counts alone
// determine the machine position.
//
// Invariants: without backlash, items pass unchanged. Reversals shorter than `least` are ignored; the tool is then off
// the path by less than `least`. At the end of a probe move, where the machine may have left the path, a callback gives
// the side of the backlash.
#pragma once

#include <functional>
#include <optional>

#include "passo/base/source.hpp"
#include "passo/path/segment.hpp"

namespace passo {

struct BacklashOptions {
  Point start;               // start of the path
  PerAxis<double> backlash;  // 0: the axis has none
  PerAxis<double> least;     // an axis that moves back by at most this has not reversed
  AxisSet downs;             // the axes whose backlash is taken up for motion in the negative direction at the start of
                             // the path
  // True: the first item takes up the initial backlash, even if there is none, so that the number of items does not
  // depend on `downs`.
  bool counts_items = false;
};

// The position of a stopped machine, and the axes whose backlash is taken up for motion in the negative direction.
struct BacklashAtRest {
  AxisSet downs;
  Point place;
};

class BacklashCompensator final : public Source<PathItem> {
 public:
  BacklashCompensator(Source<PathItem>& path, const BacklashOptions& options);

  // `at_rest` is called when the machine is stopped at the end of a probe move.
  void ask_after_probe(std::function<BacklashAtRest()> at_rest) { at_rest_ = std::move(at_rest); }

  [[nodiscard]] bool next(PathItem& item) override;

 private:
  bool has_backlash(Axis axis) const { return options_.backlash[axis] > 0; }
  bool pull(PathItem& item);
  void begin(const Segment& segment);
  bool emit_piece(PathItem& item);
  bool follow_to_next_turn();
  void take_up(const Point& at, AxisSet turned, PathItem& item);
  bool emit_start(PathItem& item);
  bool emit_end(PathItem& item);

  Source<PathItem>& path_;
  BacklashOptions options_;
  bool any_ = false;
  std::function<BacklashAtRest()> at_rest_;

  AxisSet downs_;
  Point place_;     // the end of the path so far
  Point farthest_;  // the extreme position of each axis since its last reversal
  bool asks_ = false;
  bool started_ = false;
  bool ended_ = false;

  Segment segment_;  // the current segment
  bool in_segment_ = false;
  double from_ = 0;      // the part before this s was returned
  double followed_ = 0;  // farthest_ includes the part before this s
  AxisSet turned_;       // the axes that reverse at followed_
  std::optional<Action> before_segment_;
};

}  // namespace passo
