// BacklashCompensator: takes up the backlash of an axis wherever the path reverses the axis.
//
// Position in the pipeline: before the planner. Each segment records on which side the backlash of each axis is
// (Segment::downs), so that motion can be followed from any point of a segment. There are two ways to take it up:
//
// - In motion, where the path continues smoothly: on a piece of the path where the axis stays within the tolerance of
//   its turning point, the curve of the segment contains the additional motion of the motor (Segment::lead). The
//   planner keeps the motor within the limits of its axis.
// - At a stop, everywhere else: an extra segment moves only the motor of that axis, and the tool stays on the path, to
//   within a step.
//
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
#include <memory>

#include "passo/base/source.hpp"
#include "passo/path/path_smoother.hpp"
#include "passo/path/segment.hpp"

namespace passo {

// The fraction of the tolerance that smoothing uses if an axis may take up backlash in motion. Half would be better in
// curves, but worse in corners.
inline constexpr double smoothing_share_with_backlash = 0.7;

struct BacklashOptions {
  Point start;               // start of the path
  PerAxis<double> backlash;  // 0: the axis has none
  PerAxis<double> least;     // an axis that moves back by at most this has not reversed
  AxisSet downs;             // the axes whose backlash is taken up for motion in the negative direction at the start of
                             // the path
  // True: the first item takes up the initial backlash, even if there is none, so that the number of items does not
  // depend on `downs`.
  bool counts_items = false;
  // The axes whose backlash may be taken up in motion.
  AxisSet in_motion{};
  // The fraction of the tolerance that smoothing uses on these machines (Segment::tolerance is that part). The rest is
  // for backlash that is taken up in motion. On an arc, which is exact, the whole tolerance is for backlash.
  double smoothing_share = 1;
  // Whether the acceleration must be continuous.
  Smoothness smoothness = Smoothness::least_bending;
};

// The position of a stopped machine, and the axes whose backlash is taken up for motion in the negative direction.
struct BacklashAtRest {
  AxisSet downs;
  Point place;
};

class BacklashCompensator final : public Source<PathItem> {
 public:
  BacklashCompensator(Source<PathItem>& path, const BacklashOptions& options);
  ~BacklashCompensator() override;

  // `at_rest` is called when the machine is stopped at the end of a probe move.
  void ask_after_probe(std::function<BacklashAtRest()> at_rest);

  [[nodiscard]] bool next(PathItem& item) override;

 private:
  class Implementation;
  Source<PathItem>& path_;
  std::unique_ptr<Implementation> implementation_;  // null: no axis has backlash
};

}  // namespace passo
