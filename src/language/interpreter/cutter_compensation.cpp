#include "cutter_compensation.hpp"

#include <cmath>
#include <numbers>
#include <utility>
#include <variant>

namespace passo {
namespace {

using std::numbers::pi;
// A corner that turns by less (radians) is smooth: numbers that CAM programs round must not cause an arc.
constexpr double smooth_corner = 0.05;
// The sweep of a shortened arc may be this much larger (radians) than the programmed sweep, for the same reason.
constexpr double sweep_tolerance = 0.0254;
constexpr double right_angle = 1e-6;

PlanePoint operator+(PlanePoint a, PlanePoint b) {
  return {a.first + b.first, a.second + b.second};
}
PlanePoint operator-(PlanePoint a, PlanePoint b) {
  return {a.first - b.first, a.second - b.second};
}
PlanePoint operator*(double k, PlanePoint a) {
  return {k * a.first, k * a.second};
}
double dot(PlanePoint a, PlanePoint b) {
  return a.first * b.first + a.second * b.second;
}
double cross(PlanePoint a, PlanePoint b) {
  return a.first * b.second - a.second * b.first;
}
double length(PlanePoint a) {
  return std::hypot(a.first, a.second);
}
PlanePoint unit(PlanePoint a) {
  return (1 / length(a)) * a;
}
PlanePoint turned_left(PlanePoint a) {
  return {-a.second, a.first};
}

struct Circle {
  PlanePoint center;
  double radius;
};

// Where a walk along the line meets the circle: the first time, or with `last` the second time.
bool meet(PlanePoint on_line, PlanePoint direction, const Circle& circle, bool last, PlanePoint& point) {
  const PlanePoint from_center = on_line - circle.center;
  const PlanePoint foot = from_center - dot(from_center, direction) * direction;
  const double height = length(foot);
  if (height > circle.radius) return false;
  const double half_chord = std::sqrt((circle.radius - height) * (circle.radius + height));
  point = circle.center + foot + (last ? half_chord : -half_chord) * direction;
  return true;
}

// Where two circles meet, to the left or to the right of the line from a's centre to b's.
bool meet(const Circle& a, const Circle& b, bool left, PlanePoint& point) {
  const PlanePoint between = b.center - a.center;
  const double distance = length(between);
  if (a.radius == 0 || distance == 0) return false;
  const double cosine = (a.radius * a.radius + distance * distance - b.radius * b.radius) / (2 * a.radius * distance);
  if (std::abs(cosine) > 1) return false;
  const double sine = std::sqrt((1 - cosine) * (1 + cosine));
  const PlanePoint along = unit(between);
  point = a.center + a.radius * (cosine * along + (left ? sine : -sine) * turned_left(along));
  return true;
}

// From the centre of a lathe tool's nose to the point that the program moves: a corner or a side of the square about
// the nose, numbered as in tool tables.
PlanePoint nose_of(int orientation, double radius) {
  constexpr PlanePoint origins[] = {{0, 0}, {1, -1}, {-1, -1}, {-1, 1}, {1, 1}, {1, 0}, {0, -1}, {-1, 0}, {0, 1}};
  return orientation >= 1 && orientation <= 8 ? radius * origins[orientation] : PlanePoint{};
}

}  // namespace

void CutterCompensation::start(const CutterSetup& setup) {
  plane_ = setup.plane;
  axes_ = axes_of(plane_);
  side_ = setup.left ? 1 : -1;
  radius_ = setup.radius;
  nose_ = plane_ == Plane::zx ? nose_of(setup.orientation, radius_) : PlanePoint{};
  entered_ = false;
  stopped_ = false;
  held_ = {};
}

CutterFault CutterCompensation::stop() {
  const CutterFault fault = release();
  leaving_ = leaving_ || active();
  side_ = 0;
  return fault;
}

CutterFault CutterCompensation::release() {
  stopped_ = stopped_ || held_.any;
  const CutterFault fault = held_.any && !can_reach(tool_) ? CutterFault::unreachable : CutterFault::none;
  operations_.release();
  held_ = {};
  return fault;
}

void CutterCompensation::skip_to(const Point& end) {
  (void)release();
  stopped_ = false;
  if (entered_) tool_ = beside(in_plane(end, axes_), normal_);
}

Point CutterCompensation::shift(const Point& programmed) const {
  Point shift;
  if (!active() || !entered_) return shift;
  shift[axes_.first] = tool_.first - programmed[axes_.first];
  shift[axes_.second] = tool_.second - programmed[axes_.second];
  return shift;
}

PlanePoint CutterCompensation::beside(PlanePoint contour, PlanePoint normal) const {
  return contour + radius_ * normal;
}

// The contour's direction at a place from which the tool's centre lies in the direction `normal`.
PlanePoint CutterCompensation::tangent(PlanePoint normal) const {
  return -side_ * turned_left(normal);
}

void CutterCompensation::set_end(Point& end, PlanePoint tool) const {
  end[axes_.first] = tool.first + nose_.first;
  end[axes_.second] = tool.second + nose_.second;
}

CutterCompensation::Path CutterCompensation::line_path(PlanePoint start, PlanePoint end) const {
  Path path;
  path.direction = unit(end - start);
  path.start_normal = path.end_normal = side_ * turned_left(path.direction);
  return path;
}

CutterCompensation::Path CutterCompensation::arc_path(PlanePoint start, PlanePoint end, PlanePoint center,
                                                      std::int32_t turns) const {
  Path path;
  path.is_arc = true;
  path.inside = (turns > 0) == (side_ > 0);
  path.center = center;
  const double to_center = path.inside ? 1 : -1;
  path.start_normal = to_center * unit(center - start);
  path.end_normal = to_center * unit(center - end);
  path.radius = length(center - end) - to_center * radius_;
  path.turns = turns;
  path.sweep = arc_sweep(start, end, center, turns);
  return path;
}

CutterFault CutterCompensation::line(const ContourMove& move) {
  leaving_ = false;
  const PlanePoint start = in_plane(move.start, axes_);
  const PlanePoint end = in_plane(move.end, axes_);
  if (!entered_) {
    if (start == end) return CutterFault::entry_too_short;
    return enter_by_line(move, line_path(start, end));
  }
  if (start == end) {  // only other axes move, and the tool's place depends on the next corner
    Operation operation = move.origin;
    operation.what = operation_of(move, {});
    operations_.hold(operation);
    if (!held_.any) held_ = {true, false, tool_, {}};
    return CutterFault::none;
  }
  return turn_corner(move, line_path(start, end));
}

CutterFault CutterCompensation::arc(const ContourMove& move, PlanePoint center, std::int32_t turns) {
  const PlanePoint start = in_plane(move.start, axes_);
  const PlanePoint end = in_plane(move.end, axes_);
  const Path path = arc_path(start, end, center, turns);
  const double entry_radius = length(center - start) - (entered_ ? 0 : radius_);
  if (path.radius <= 0 || (path.inside && entry_radius <= 0)) return give_up(path, CutterFault::arc_too_small);
  return entered_ ? turn_corner(move, path) : enter_by_arc(move, path);
}

// A line from the tool's place to beside the end of the programmed move. The line cuts nothing of the contour, so an
// inside corner may change its direction freely.
CutterFault CutterCompensation::enter_by_line(const ContourMove& move, const Path& path) {
  if (length(in_plane(move.end, axes_) - in_plane(move.start, axes_)) <= radius_) {
    return give_up(path, CutterFault::entry_too_short);
  }
  entered_ = true;
  hold(move, path, false, in_plane(move.start, axes_));
  return CutterFault::none;
}

// An arc from the tool's place to beside the end of the programmed arc, with the same direction there. The arc's centre
// is on the line through the end and the programmed centre, as far from the end as from the start.
CutterFault CutterCompensation::enter_by_arc(const ContourMove& move, Path path) {
  const PlanePoint start = in_plane(move.start, axes_);
  const PlanePoint contour = in_plane(move.end, axes_);
  if (length(contour - start) <= radius_) return give_up(path, CutterFault::entry_too_short);
  const PlanePoint end = beside(contour, path.end_normal);
  const PlanePoint inward = unit(path.center - end);
  const PlanePoint chord = start - end;
  const double ahead = dot(chord, inward);
  if (ahead <= right_angle * length(chord)) return give_up(path, CutterFault::entry_arc);
  path.radius = dot(chord, chord) / (2 * ahead);
  path.center = end + path.radius * inward;
  path.sweep = arc_sweep(start, end, path.center, path.turns);
  if (nose_ != PlanePoint{}) {  // the tool's point must go to the start of the new arc first
    Operation operation = move.origin;
    Point at = move.end;
    set_end(at, start);
    at[axes_.normal] = move.start[axes_.normal];
    operation.what = operation::StraightFeed{at};
    operations_.push(operation);
  }
  entered_ = true;
  hold(move, path, true, start);
  return CutterFault::none;
}

// Makes the corner between the last move and this one. Then holds this one.
CutterFault CutterCompensation::turn_corner(const ContourMove& move, const Path& path) {
  const PlanePoint contour = in_plane(move.start, axes_);
  double outside_turn = 0;
  const Corner corner = corner_before(path, outside_turn);
  PlanePoint from = tool_;
  if (corner == Corner::inside && held_.any && !inside_corner_point(path, contour, outside_turn, from)) {
    return give_up(path, CutterFault::no_room);
  }
  const bool known_start = held_.any;
  const bool stopped = std::exchange(stopped_, false);
  if (const CutterFault fault = end_held_at(from); fault != CutterFault::none) return give_up(path, fault);
  if (corner == Corner::outside) {
    from = beside(contour, path.start_normal);
    go_round(move, from);
  }
  hold(move, path, known_start || corner != Corner::inside, from);
  return stopped && corner == Corner::inside ? CutterFault::cut_corner : CutterFault::none;
}

// The moves after a wrong move go on from its end, as if it had been made.
CutterFault CutterCompensation::give_up(const Path& path, CutterFault fault) {
  entered_ = true;
  normal_ = path.end_normal;
  return fault;
}

// outside_turn: the angle by which the contour turns away from the tool, from -90 to 270 degrees. Below 0 and above 180
// the contour turns towards the tool.
CutterCompensation::Corner CutterCompensation::corner_before(const Path& next, double& outside_turn) const {
  outside_turn = -side_ * std::atan2(cross(normal_, next.start_normal), dot(normal_, next.start_normal));
  if (outside_turn < -pi / 2) outside_turn += 2 * pi;
  if (outside_turn < -smooth_corner || outside_turn > pi + smooth_corner) return Corner::inside;
  if (outside_turn > pi - smooth_corner) {
    // The contour turns back. The tool goes round the end of a line. If an arc bulges towards the tool, the tool is in
    // a wedge.
    const bool wedge = next.is_arc ? !next.inside : held_.any && held_.path.is_arc && !held_.path.inside;
    return wedge ? Corner::inside : Corner::outside;
  }
  return outside_turn > smooth_corner ? Corner::outside : Corner::smooth;
}

bool CutterCompensation::inside_corner_point(const Path& next, PlanePoint contour, double outside_turn,
                                             PlanePoint& point) const {
  const Path& last = held_.path;
  const Circle last_circle{last.center, last.radius};
  const Circle next_circle{next.center, next.radius};
  if (last.is_arc && next.is_arc) {
    return meet(last_circle, next_circle, (last.inside == next.inside) == (side_ > 0), point);
  }
  if (last.is_arc) return meet(beside(contour, next.start_normal), next.direction, last_circle, !last.inside, point);
  if (next.is_arc) return meet(tool_, tangent(normal_), next_circle, next.inside, point);
  const double turn = outside_turn < 0 ? -outside_turn : 2 * pi - outside_turn;
  point = tool_ - radius_ * std::tan(turn / 2) * tangent(normal_);
  return true;
}

// Whether the held move leads from its real start to `end` without being reversed.
bool CutterCompensation::can_reach(PlanePoint end) const {
  if (!held_.can_gouge) return true;
  const Path& path = held_.path;
  if (!path.is_arc) return dot(path.direction, end - held_.from) >= 0;
  const double sweep = arc_sweep(held_.from, end, path.center, path.turns);
  return std::abs(sweep) <= std::abs(path.sweep) + sweep_tolerance;
}

// Ends the held move at this place. Held moves after it that move only other axes are at this place too.
CutterFault CutterCompensation::end_held_at(PlanePoint end) {
  if (held_.any && !can_reach(end)) return CutterFault::unreachable;
  for (std::size_t i = 0; i < operations_.held(); ++i) {
    OperationKind& what = operations_.held(i).what;
    if (auto* const line = std::get_if<operation::StraightFeed>(&what)) set_end(line->end, end);
    if (auto* const rapid = std::get_if<operation::StraightTraverse>(&what)) set_end(rapid->end, end);
    if (auto* const arc = std::get_if<operation::ArcFeed>(&what)) set_end(arc->end, end);
  }
  operations_.release();
  held_ = {};
  return CutterFault::none;
}

// Goes round an outside corner. There is no rapid arc, so a rapid move takes the chord.
void CutterCompensation::go_round(const ContourMove& move, PlanePoint to) {
  Point end = move.end;
  set_end(end, to);
  end[axes_.normal] = move.start[axes_.normal];
  const PlanePoint center = in_plane(move.start, axes_) + nose_;
  Operation operation = move.origin;
  if (move.rapid) {
    operation.what = operation::StraightTraverse{end};
  } else {
    operation.what = operation::ArcFeed{plane_, end, Mm(center.first), Mm(center.second), -side_};
  }
  operations_.push(operation);
}

void CutterCompensation::hold(const ContourMove& move, const Path& path, bool can_gouge, PlanePoint from) {
  normal_ = path.end_normal;
  tool_ = beside(in_plane(move.end, axes_), normal_);
  held_ = {true, can_gouge, from, path};
  Operation operation = move.origin;
  operation.what = operation_of(move, path);
  operations_.hold(operation);
}

OperationKind CutterCompensation::operation_of(const ContourMove& move, const Path& path) const {
  Point end = move.end;
  set_end(end, tool_);
  if (path.is_arc) {
    const PlanePoint center = path.center + nose_;
    return operation::ArcFeed{plane_, end, Mm(center.first), Mm(center.second), path.turns};
  }
  if (move.rapid) return operation::StraightTraverse{end};
  return operation::StraightFeed{end};
}

}  // namespace passo
