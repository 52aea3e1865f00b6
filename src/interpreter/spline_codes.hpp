// SplineCodes: splines. G5 and G5.1, which are Bézier curves, and the NURBS between G5.2 and G5.3.
//
// All lie in X and Y, which LinuxCNC names by their words; the other axes stay. G5.2 is modal: each block gives one
// control point, with its weight P, and the tool moves at G5.3. Between the two nothing may move the tool or the frame.
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
  // Another code moves: a G5 that follows has no direction to go on in.
  void interrupt() { exit_.reset(); }

  // From G5.2 to G5.3.
  bool nurbs_is_open() const { return nurbs_.open; }
  // What would move the tool or the frame, or ends the program, is told, and the curve given up.
  void check_nurbs_is_closed();
  // The program is over.
  void report_open_nurbs();

 private:
  bool check();
  bool check_axes();
  bool fail_pair(std::string_view name, char first, char second, std::string expected);
  bool check_nurbs();
  bool check_nurbs_feed();
  bool add_nurbs_point(bool first);
  void close_nurbs();

  // The control points of a G5 or G5.1, which its operation borrows; and where the last G5 leads on from its end, as
  // long as G5 follows G5.
  std::array<operation::ControlPoint, 4> points_{};
  std::optional<PlanePoint> exit_;
  // Memory grows with the points of the longest NURBS, up to a bound, and is kept.
  struct OpenNurbs {
    static constexpr std::size_t most_points = 4096;
    std::vector<operation::ControlPoint> points = {};
    std::int32_t order = 0;
    std::uint32_t line = 0;  // where it begins
    bool wrong = false;      // a point was refused, and that was told
    bool open = false;
  };
  OpenNurbs nurbs_;
};

}  // namespace passo
