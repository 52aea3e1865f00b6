// BacklashStops: finds where an axis with backlash reverses, and takes up its backlash there at a stop.
//
// It cuts the path at the reversal and inserts a segment in which only the motor of the axis moves
// (Segment::takes_up_backlash). BacklashOverlap replaces such a segment where the path need not stop. Private to path/.
#pragma once

#include <functional>
#include <optional>

#include "passo/path/backlash_compensator.hpp"

namespace passo {

class BacklashStops final : public Source<PathItem> {
 public:
  BacklashStops(Source<PathItem>& path, const BacklashOptions& options);

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
