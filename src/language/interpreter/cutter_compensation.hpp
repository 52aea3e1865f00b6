// CutterCompensation: G41 and G42. It turns the programmed contour into the path of the tool's centre, and works
// between the motion codes and the queue of operations.
//
//            ┌──────── tool's centre            outside corner: an arc about the programmed point
//            │  ┌───── contour                  inside corner: both moves end where their offsets meet
//            │  │
//
// The end of a move is known only when the next move is known. So a move is held back in the queue, with everything
// between the two moves, and is shortened if the corner is an inside corner. Geometry is in the plane's own two axes;
// all others move along with the programmed move. A move that an inside corner would turn round cannot be reached
// without cutting into the contour (gouging) and is a fault.
//
// The result is what LinuxCNC 2.9 prints (documentation: "Cutter compensation"), with its entry moves, corner tolerance
// and choice of intersection. Lengths are in millimetres.
#pragma once

#include <cstdint>

#include "arc_center.hpp"
#include "operation_queue.hpp"

#include "passo/geometry/axes.hpp"

namespace passo {

struct CutterSetup {
  Plane plane = Plane::xy;
  bool left = true;  // whether the tool is left of the contour, seen along the contour
  double radius = 0;
  // For a lathe tool, the programmed point is a corner or a side of the square about the nose's centre: 1 to 8. With 0
  // and 9 it is the centre.
  int orientation = 0;
};

enum class CutterFault : std::uint8_t {
  none,
  entry_too_short,  // the first move does not lead out of the tool
  entry_arc,        // no arc leads from where the tool is to beside the contour
  arc_too_small,    // the tool does not fit into the arc
  no_room,          // the offsets of two moves do not meet
  unreachable,      // the move before would be reversed
  cut_corner,       // only a warning: because of a stop, the move before an inside corner ran to its end
};

// A move as it is programmed, in work coordinates.
struct ContourMove {
  bool rapid = false;  // true: a straight rapid move
  Point start;
  Point end;
  Operation origin;  // source, file and text of the operations that are made of this move
};

class CutterCompensation {
 public:
  explicit CutterCompensation(OperationQueue& operations) : operations_(operations) {}

  void start(const CutterSetup& setup);
  // G40. The tool stays. The next move, which must be straight, starts at the tool's centre.
  [[nodiscard]] CutterFault stop();
  // True: line() and arc() must be told of every move. A radius of zero compensates nothing.
  bool active() const { return side_ != 0 && radius_ > 0; }
  // True: there was a G40, and no straight move since.
  bool leaving() const { return leaving_; }
  void left() { leaving_ = false; }

  [[nodiscard]] CutterFault line(const ContourMove& move);
  [[nodiscard]] CutterFault arc(const ContourMove& move, PlanePoint center, std::int32_t turns);
  // Releases the held move unchanged, because the machine stops here or the program ends.
  [[nodiscard]] CutterFault release();
  // Goes on from the end of a move that was wrong.
  void skip_to(const Point& end);

  // The way from the programmed position to the tool's centre.
  Point shift(const Point& programmed) const;
  double radius() const { return radius_; }

 private:
  // The new move beside a corner: a line, or an arc with this centre and this radius of the tool's path.
  struct Path {
    bool is_arc = false;
    bool inside = false;      // the tool runs inside the arc
    PlanePoint start_normal;  // from the contour to the tool's centre
    PlanePoint end_normal;
    PlanePoint direction;  // only of a line
    PlanePoint center;
    double radius = 0;
    std::int32_t turns = 0;
    double sweep = 0;
  };
  // The held move. `from` is its real start.
  struct Held {
    bool any = false;
    bool can_gouge = false;
    PlanePoint from;
    Path path;
  };
  enum class Corner : std::uint8_t { smooth, outside, inside };

  Path line_path(PlanePoint start, PlanePoint end) const;
  Path arc_path(PlanePoint start, PlanePoint end, PlanePoint center, std::int32_t turns) const;
  CutterFault enter_by_line(const ContourMove& move, const Path& path);
  CutterFault enter_by_arc(const ContourMove& move, Path path);
  CutterFault turn_corner(const ContourMove& move, const Path& path);
  Corner corner_before(const Path& next, double& outside_turn) const;
  bool inside_corner_point(const Path& next, PlanePoint contour, double outside_turn, PlanePoint& point) const;
  CutterFault give_up(const Path& path, CutterFault fault);
  bool can_reach(PlanePoint end) const;
  CutterFault end_held_at(PlanePoint end);
  void go_round(const ContourMove& move, PlanePoint to);
  void hold(const ContourMove& move, const Path& path, bool can_gouge, PlanePoint from);

  PlanePoint beside(PlanePoint contour, PlanePoint normal) const;
  PlanePoint tangent(PlanePoint normal) const;
  void set_end(Point& end, PlanePoint tool) const;
  OperationKind operation_of(const ContourMove& move, const Path& path) const;

  OperationQueue& operations_;
  PlaneAxes axes_ = axes_of(Plane::xy);
  Plane plane_ = Plane::xy;
  int side_ = 0;  // 1: left of the contour, -1: right, 0: off
  double radius_ = 0;
  PlanePoint nose_;       // from the nose's centre to the point that a lathe program moves
  bool entered_ = false;  // the first move is done
  bool leaving_ = false;
  bool stopped_ = false;  // release() let the last move run to its end
  PlanePoint tool_;       // the tool's centre at the end of the last move, before the next corner is known
  PlanePoint normal_;     // the direction from the end of the contour so far to `tool_`
  Held held_;
};

}  // namespace passo
