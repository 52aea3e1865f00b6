// LatheContour: the contour of a lathe part (G70 to G72) as lines and arcs in Z and X, and its offset.
//
// A point is a complex number: Z is the real part, X the imaginary part. A rotation is therefore a product, a
// reflection is a conjugate, and the sign of a product gives the side of a line. Lengths and tolerances are in the
// program's units, as in LinuxCNC (interp_g7x.cc). The moves are those of LinuxCNC.
//
// All cuts are computed in one orientation: Z decreases along the contour, and the contour's last point is not lower in
// X than its first. LatheOrientation converts from there back to the program's orientation.
#pragma once

#include <complex>
#include <cstdint>
#include <vector>

namespace passo {

using LathePoint = std::complex<double>;

namespace lathe_tolerance {
inline constexpr double same = 1e-6;   // points and heights within this distance are equal
inline constexpr double small = 1e-3;  // smaller segments are dropped; a segment may go back by this much
inline constexpr double gap = 1e-2;    // an arc closes a gap that is wider in Z
}  // namespace lathe_tolerance

struct LatheSegment {
  enum class Shape : std::uint8_t { line, clockwise, counterclockwise, fillet, chamfer };
  Shape shape = Shape::line;
  LathePoint start;
  LathePoint end;
  LathePoint center{};     // centre of an arc; unused for a line
  double size = 0;         // radius of a fillet; a chamfer connects the ends of such a fillet
  std::uint32_t line = 0;  // line of the program

  bool is_arc() const { return shape == Shape::clockwise || shape == Shape::counterclockwise; }
  bool is_corner() const { return shape == Shape::fillet || shape == Shape::chamfer; }
  double radius() const { return std::abs(start - center); }
  // Returns a line's length, or the smaller of an arc's chord and radius. An offset must be small compared with it.
  double extent() const;
  // Returns whether Z decreases from start to end. An arc must also lie on one side of its centre in X.
  bool goes_one_way() const;
  void offset(double distance);
  void move(LathePoint by);
};

// The points (up to two) at which a segment has this X. For an arc the larger Z comes first.
struct LatheCrossings {
  int count = 0;
  double z[2] = {};
  double front() const { return z[0]; }
  double back() const { return z[count - 1]; }
};
LatheCrossings crossings(const LatheSegment& segment, double x);

struct LatheOrientation {
  bool turned = false;  // rotated by -90 degrees, for facing
  bool mirrored_z = false;
  bool mirrored_x = false;
  LathePoint to_program(LathePoint point) const;
  bool swaps_arcs() const { return mirrored_z != mirrored_x; }
};

enum class LatheFault : std::uint8_t { none, not_monotonic, corner, parallel, vanished, stuck };

class LatheContour {
 public:
  std::vector<LatheSegment> segments;
  LatheOrientation orientation;

  void turn();    // rotates by -90 degrees, for facing
  void orient();  // mirrors the contour, so that Z decreases and X increases
  bool goes_one_way() const;
  // Replaces fillets by arcs and chamfers by lines.
  LatheFault work_out_corners();
  LatheFault check_one_way();
  // Offsets the contour away from the part. The first segment leads to the contour, so only its end moves.
  LatheFault offset(double distance);

 private:
  LatheFault offset_a_little(double distance);
  void close_gaps(double distance);
  LatheFault join();
};

}  // namespace passo
