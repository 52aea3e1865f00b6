// MotionCodes: lines, arcs and spindle-synchronised feeds: G0 to G3, G33, G33.1.
#pragma once

#include "code_family.hpp"
#include "cutter_codes.hpp"

namespace passo {

class MotionCodes : private CodeFamily {
 public:
  MotionCodes(BlockContext& block, CutterCodes& cutter_codes) : CodeFamily(block), cutter_codes_(cutter_codes) {}

  // Refuses what cannot be scaled (G51).
  bool check_scaling(CodeNumber code);
  bool traverse();
  bool feed();
  bool arc(bool clockwise);
  bool threading(bool tapping);

 private:
  bool straight(bool rapid, const Point& start);
  bool arc_beside(const Point& start, PlanePoint center, std::int32_t turns);
  bool find_arc_center(bool clockwise, const Point& end, ArcCenter& found);
  bool center_words(PlanePoint start, PlanePoint& center);
  PlanePoint center_by_words(PlanePoint start, bool absolute) const;
  bool fits_other_distance(PlanePoint from, PlanePoint to, const ArcTolerance& tolerance);
  bool arc_turns(std::int32_t& turns);

  CutterCodes& cutter_codes_;
};

}  // namespace passo
