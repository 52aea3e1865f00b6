// BacklashTaker: takes up the backlash of an axis wherever the path turns the axis back.
//
// Place on the street: before the planner. Segments are cut where an axis with backlash turns back. The path rests
// there, and a segment of its own moves the motor of that axis alone, within the limits of the axis, until the backlash
// is taken up. The tool stands meanwhile. So the tool stays on the path, to the step. Each segment tells on which side
// the backlash of each axis is (Segment::downs), so that a segment can be followed from any place of it. See
// docs/decisions/0083-backlash-is-taken-up-at-rest.md.
//
// A path begins and ends with all backlash taken up for motion up. So where a machine stands needs no more than the
// counts of its motors.
//
// Invariants: without backlash, items pass unchanged. An axis that turns back by less than `least` does not count; the
// tool is then off the path by less than `least`. Where the machine may leave the path, at the end of a probe move, the
// side of the backlash is asked for.
#pragma once

#include <functional>
#include <optional>

#include "passo/base/source.hpp"
#include "passo/path/segment.hpp"

namespace passo {

struct BacklashOptions {
  Point start;               // where the path begins
  PerAxis<double> backlash;  // 0: the axis has none
  PerAxis<double> least;     // an axis that goes back by no more has not turned back
  AxisSet downs;             // the axes whose backlash is taken up for motion down when the path begins
  // True: the first item stands for whatever must be taken up at first, also if that is nothing. So the number of items
  // does not depend on `downs`.
  bool counts_items = false;
};

// Where a machine rests, and the axes whose backlash is then taken up for motion down.
struct BacklashAtRest {
  AxisSet downs;
  Point place;
};

class BacklashTaker final : public Source<PathItem> {
 public:
  BacklashTaker(Source<PathItem>& path, const BacklashOptions& options);

  // `at_rest` is asked when the machine rests at the end of a probe move.
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
  Point place_;     // where the path has come to
  Point farthest_;  // the farthest place of each axis since it turned back
  bool asks_ = false;
  bool started_ = false;
  bool ended_ = false;

  Segment segment_;  // the present segment
  bool in_segment_ = false;
  double from_ = 0;      // the part before this s was given
  double followed_ = 0;  // farthest_ counts the part before this s
  AxisSet turned_;       // the axes that turn back at followed_
  std::optional<Action> before_segment_;
};

}  // namespace passo
