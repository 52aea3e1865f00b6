// SplineCodes: the Bézier curves of G5 and G5.1, and the NURBS between G5.2 and G5.3.
//
// All these curves lie in X and Y; the other axes do not move. G5.2 is modal: each block gives one control point with
// its weight P. At G5.3 the tool moves along the curve. Between G5.2 and G5.3 nothing may move the tool or the frame.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "code_family.hpp"

namespace passo {

class SplineCodes : private CodeFamily {
 public:
  explicit SplineCodes(BlockContext& block) : CodeFamily(block) {}

  bool cubic();
  bool quadratic();
  bool nurbs_point();
  bool end_nurbs();
  // Notes a move by another code, so that a following G5 has no previous curve whose direction it could continue.
  void interrupt() { exit_.reset(); }

  // Returns true from G5.2 to G5.3.
  bool nurbs_is_open() const { return nurbs_.open; }
  // Reports a code that would move the tool or the frame, or that ends the program. The curve is then abandoned.
  void check_nurbs_is_closed();
  // Must be called at the end of the program.
  void report_open_nurbs();

 private:
  bool check();
  bool check_axes();
  bool fail_pair(std::string_view name, char first, char second, FindingWords expected);
  bool check_nurbs();
  bool check_nurbs_feed();
  bool add_nurbs_point(bool first);
  void close_nurbs();

  // The control points of a G5 or G5.1, to which its operation refers.
  std::array<operation::ControlPoint, 4> points_{};
  // The final direction of the last G5. Empty: the last motion was not a G5.
  std::optional<PlanePoint> exit_;
  // Memory grows with the points of the longest NURBS, up to most_points, and is not released.
  struct OpenNurbs {
    static constexpr std::size_t most_points = 4096;
    std::vector<operation::ControlPoint> points = {};
    std::int32_t order = 0;
    std::uint32_t line = 0;  // first line of the NURBS
    bool wrong = false;      // true: a block of the NURBS was invalid, which was reported
    bool open = false;
  };
  OpenNurbs nurbs_;
};

}  // namespace passo
