// CutterCompensation: G41 and G42. It offsets the programmed contour to the path of the tool centre, between the motion
// codes and the queue of operations.
//
//            ┌──────── tool centre              outside corner: an arc about the programmed point
//            │  ┌───── contour                  inside corner: both moves end where their offsets meet
//            │  │
//
// The end of a move is known only when the next move is known. Therefore a move is held back in the queue, with
// everything between the two moves, and is shortened at an inside corner. Geometry is in the two axes of the plane; all
// others follow the programmed move. A move that an inside corner would reverse cannot be cut without gouging the
// contour, and is an error.
//
// The result is that of LinuxCNC 2.9 (documentation: "Cutter compensation"), including its entry moves, corner
// tolerance and choice of intersection. Lengths are in millimetres.
#pragma once

#include <cstdint>

#include "arc_center.hpp"
#include "operation_queue.hpp"

#include "passo/geometry/axes.hpp"

namespace passo {

struct CutterSetup {
  Plane plane = Plane::xy;
  bool left = true;  // whether the tool is left of the contour, seen in the direction of travel
  double radius = 0;
  // For a lathe tool, the programmed point is a corner or a side of the square about the nose centre: 1 to 8. With 0
  // and 9 it is the centre.
  int orientation = 0;
};

enum class CutterFault : std::uint8_t {
  none,
  entry_too_short,  // the first move does not lead out of the tool
  entry_arc,        // no arc leads from the tool position to the offset contour
  arc_too_small,    // the tool does not fit into the arc
  no_room,          // the offsets of two moves do not meet
  unreachable,      // the previous move would be reversed
  cut_corner,       // only a warning: because of a stop, the move before an inside corner was not shortened
};

// A programmed move, in work coordinates.
struct ContourMove {
  bool rapid = false;  // true: a straight rapid move
  Point start;
  Point end;
  Operation origin;  // source, file and text of the operations generated from this move
};

class CutterCompensation {
 public:
  explicit CutterCompensation(OperationQueue& operations) : operations_(operations) {}

  void start(const CutterSetup& setup);
  // G40. The tool stays. The next move, which must be straight, starts at the tool centre.
  [[nodiscard]] CutterFault stop();
  // Returns whether line() and arc() must be called for every move. A radius of zero compensates nothing.
  bool active() const { return side_ != 0 && radius_ > 0; }
  // Returns whether there was a G40, and no straight move since.
  bool leaving() const { return leaving_; }
  void left() { leaving_ = false; }

  [[nodiscard]] CutterFault line(const ContourMove& move);
  [[nodiscard]] CutterFault arc(const ContourMove& move, PlanePoint center, std::int32_t turns);
  // Releases the held move unchanged, because the machine stops here or the program ends.
  [[nodiscard]] CutterFault release();
  // Continues from the end of an invalid move.
  void skip_to(const Point& end);

  // Returns the offset from the programmed position to the tool centre.
  Point shift(const Point& programmed) const;
  double radius() const { return radius_; }

 private:
  // The offset move: a line, or an arc with the centre and the radius of the tool path.
  struct Path {
    bool is_arc = false;
    bool inside = false;      // the tool is inside the arc
    PlanePoint start_normal;  // from the contour to the tool centre
    PlanePoint end_normal;
    PlanePoint direction;  // direction of a line; unused for an arc
    PlanePoint center;
    double radius = 0;
    std::int32_t turns = 0;
    double sweep = 0;
  };
  // The held move. `from` is its actual start.
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
  PlanePoint nose_;       // from the nose centre to the programmed point of a lathe tool
  bool entered_ = false;  // the entry move is done
  bool leaving_ = false;
  bool stopped_ = false;  // release() left the last move unshortened
  PlanePoint tool_;       // the tool centre at the end of the last move, before the next corner is known
  PlanePoint normal_;     // the direction from the end of the contour so far to `tool_`
  Held held_;
};

}  // namespace passo
