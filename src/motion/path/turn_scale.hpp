// TurnScale: weights a degree of A, B and C by the ratio of the tolerances.
//
// PathSmoother measures deviations as one distance over all axes. TurnScale divides A, B and C by a number of degrees,
// the turn unit, so that one unit may deviate as far as one millimetre: turn_tolerance / tolerance, or a little less.
// convert_to_degrees() is its inverse for the smoothed segments.
//
// The unit is a sum of two powers of two. Dividing a 52-bit number by such a unit and multiplying the result by it
// gives the same number again (D. Goldberg, "What every computer scientist should know about floating-point
// arithmetic", 1991, theorem 7). PathBuilder rounds angles to 52 bits. So the smoothed path begins and ends exactly
// where the programmed one does.
//
// The unit changes only at a stop of the path. If the tolerance changes between moves, and one of them turns A, B or
// C, the path stops once. If none turns, the path does not stop.
#pragma once

#include "passo/base/source.hpp"
#include "passo/path/segment.hpp"

namespace passo {

class TurnScale final : public Source<PathItem> {
 public:
  // `share`: the fraction of each tolerance that may be used.
  explicit TurnScale(Source<PathItem>& path, double share = 1) : path_(path), share_(share) {}

  [[nodiscard]] bool next(PathItem& item) override;

 private:
  bool pull();
  void scale(Segment& segment);

  Source<PathItem>& path_;
  double share_;
  PathItem ahead_;
  bool has_ahead_ = false;
  bool at_end_ = false;
  bool has_tolerance_ = false;  // some segment had a tolerance for A, B and C
  double unit_ = 1;             // degrees
  bool rests_ = true;           // before the next segment
  bool has_turned_ = false;     // A, B or C, since the last rest
  bool is_wide_ = false;        // a tolerance since then is too wide for turns in this unit
};

// The largest sum of two powers of two that is at most the ratio, except for rounding. `ratio` is above 0.
double largest_turn_unit(double ratio);

// The nearest number of 52 bits; a double has 53.
double with_52_bits(double value);

void convert_to_degrees(Segment& segment);

}  // namespace passo
