// The contour of a lathe part (G70 to G72), as lines and arcs in Z and X, and how it is set off from itself.
//
// A point is a complex number, Z real and X imaginary: turning and mirroring are products then, and the side of a line
// is the sign of one. Lengths are the program's units, and so are the tolerances, as in LinuxCNC (interp_g7x.cc), whose
// moves these cycles make.
//
// Everything is worked out in one orientation: Z falls along the contour and X rises from its first point to its last.
// `LatheOrientation` says how a program's contour lies in it.
#pragma once

#include <complex>
#include <cstdint>
#include <vector>

namespace passo {

using LathePoint = std::complex<double>;

namespace lathe_tolerance {
inline constexpr double same = 1e-6;   // points and heights
inline constexpr double small = 1e-3;  // segments that are dropped, and what still counts as one direction
inline constexpr double gap = 1e-2;    // between two segments: closed by an arc
}  // namespace lathe_tolerance

struct LatheSegment {
  enum class Shape : std::uint8_t { line, clockwise, counterclockwise, fillet, chamfer };
  Shape shape = Shape::line;
  LathePoint start;
  LathePoint end;
  LathePoint center{};     // of an arc
  double size = 0;         // of a fillet (its radius) and a chamfer, until they are worked out
  std::uint32_t line = 0;  // of the program

  bool is_arc() const { return shape == Shape::clockwise || shape == Shape::counterclockwise; }
  bool is_corner() const { return shape == Shape::fillet || shape == Shape::chamfer; }
  double radius() const { return std::abs(start - center); }
  // What an offset may not come near: the length of a line, of an arc its chord or its radius.
  double extent() const;
  // Z falls all along, and an arc does not turn round in X more than once.
  bool goes_one_way() const;
  void offset(double distance);
  void move(LathePoint by);
};

// Where a segment is at this height of X: none, one or two Z; for an arc the larger Z first.
struct LatheCrossings {
  int count = 0;
  double z[2] = {};
  double front() const { return z[0]; }
  double back() const { return z[count - 1]; }
};
LatheCrossings crossings(const LatheSegment& segment, double x);

struct LatheOrientation {
  bool turned = false;  // by -90 degrees: facing
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

  void turn();    // for facing
  void orient();  // by mirroring: Z falls, X rises
  bool goes_one_way() const;
  // Fillets and chamfers become arcs and lines.
  LatheFault work_out_corners();
  LatheFault check_one_way();
  // All but the first segment, which leads to the contour, away from the part.
  LatheFault offset(double distance);

 private:
  LatheFault offset_a_little(double distance);
  void close_gaps(double distance);
  LatheFault join();
};

}  // namespace passo
