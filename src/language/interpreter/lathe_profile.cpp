#include "lathe_profile.hpp"

#include <algorithm>
#include <cmath>

namespace passo {
namespace {

using Shape = LatheSegment::Shape;
using namespace lathe_tolerance;
constexpr LathePoint i{0, 1};
constexpr int most_offset_steps = 100'000;

double cross(LathePoint a, LathePoint b) {
  return std::imag(std::conj(a) * b);
}

bool within_arc(const LatheSegment& arc, LathePoint point) {
  const double turn = arc.shape == Shape::counterclockwise ? 1 : -1;
  return turn * cross(arc.start - arc.center, point - arc.center) >= -same &&
         turn * cross(arc.end - arc.center, point - arc.center) <= same;
}

void meet(LatheSegment& first, LatheSegment& second, LathePoint point) {
  first.end = second.start = point;
}

bool meet_lines(LatheSegment& first, LatheSegment& second) {
  const LathePoint direction = first.end - first.start;
  const LathePoint other = second.end - second.start;
  const double sine = cross(direction, other);
  if (std::abs(sine) < 1e-12 * std::abs(direction) * std::abs(other)) {
    if (std::abs(first.end - second.start) > small) return false;
    meet(first, second, first.end);
    return true;
  }
  // Both lines are turned so that the second one lies on the real axis. `part` of the first line leads to that axis.
  const LathePoint turn = -std::conj(other) / std::abs(other);
  const LathePoint from = (first.start - second.end) * turn;
  const LathePoint to = (first.end - second.end) * turn;
  const double part = from.imag() / std::imag(from - to);
  meet(first, second, (from + part * (to - from)) / turn + second.end);
  return true;
}

// The line counts as endless. Of its two crossings with the circle, takes the one nearer to the second segment's start.
void meet_line_and_arc(LatheSegment& first, LatheSegment& second) {
  if (std::abs(second.start - first.end) < same) return;
  const bool line_first = !first.is_arc();
  const LatheSegment& line = line_first ? first : second;
  const LatheSegment& arc = line_first ? second : first;
  const double radius = std::abs(arc.end - arc.center);
  const LathePoint along = (line.end - line.start) / std::abs(line.end - line.start);
  const LathePoint to_center = (arc.center - line.end) / along;
  const double half_chord = std::sqrt(std::max(0.0, radius * radius - to_center.imag() * to_center.imag()));
  const LathePoint one = line.end + along * (to_center.real() + half_chord);
  const LathePoint two = line.end + along * (to_center.real() - half_chord);
  meet(first, second, std::abs(second.start - one) < std::abs(second.start - two) ? one : two);
}

void meet_arcs(LatheSegment& first, LatheSegment& second) {
  const LathePoint between = first.center - second.center;
  const double distance = std::abs(between);
  if (distance < same) return;  // arcs with one centre do not cross
  const double radius = second.radius();
  const double other = first.radius();
  const double cosine = (distance * distance + radius * radius - other * other) / (2 * distance * radius);
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  const LathePoint toward = between / distance * radius;
  const LathePoint one = second.center + LathePoint(cosine, sine) * toward;
  const LathePoint two = second.center + LathePoint(cosine, -sine) * toward;
  // Arcs that nearly touch cross at two close places. With `gap` every step takes the same one, which is LinuxCNC's.
  meet(first, second, std::abs(second.start - one) <= std::abs(second.start - two) + gap ? one : two);
}

// Sets the end of the first and the start of the second segment to where they cross. False: parallel lines.
bool meet(LatheSegment& first, LatheSegment& second) {
  if (first.is_arc() && second.is_arc()) {
    meet_arcs(first, second);
  } else if (first.is_arc() || second.is_arc()) {
    meet_line_and_arc(first, second);
  } else {
    return meet_lines(first, second);
  }
  return true;
}

// The circle in a corner touches both segments. The corner begins and ends where the circle touches them.
bool work_out_corner(LatheSegment& before, LatheSegment& corner, LatheSegment& after) {
  double side = corner.size;
  LatheSegment first = before;
  LatheSegment second = after;
  const auto set_off = [&](double distance) {
    (first = before).offset(distance);
    (second = after).offset(distance);
    return std::real(first.end - second.start) <= gap;
  };
  if (!set_off(side) && !set_off(side = -side)) return false;
  if (!meet(first, second)) return false;
  corner.center = (first.end + second.start) / 2.0;
  first.offset(-side);
  second.offset(-side);
  corner.start = before.end = first.end;
  corner.end = after.start = second.start;
  if (corner.shape == Shape::chamfer) {
    corner.shape = Shape::line;
  } else {
    const bool above = std::imag(corner.start - corner.center) > 0 || std::imag(corner.end - corner.center) > 0;
    corner.shape = above ? Shape::counterclockwise : Shape::clockwise;
  }
  return true;
}

void drop_small(std::vector<LatheSegment>& segments) {
  std::erase_if(segments, [](const LatheSegment& segment) { return segment.extent() < small; });
}

}  // namespace

double LatheSegment::extent() const {
  const double length = std::abs(end - start);
  return is_arc() ? std::min(length, radius()) : length;
}

bool LatheSegment::goes_one_way() const {
  const double along = std::real(end - start);
  if (!is_arc()) return along <= small;
  const double side = shape == Shape::counterclockwise ? 1 : -1;
  return side * std::imag(start - center) >= -small && side * std::imag(end - center) >= -small && along <= -small;
}

void LatheSegment::offset(double distance) {
  if (!is_arc()) return move(i * distance * (start - end) / std::abs(start - end));
  const double larger = shape == Shape::counterclockwise ? distance : -distance;
  const double factor = 1 + larger / radius();
  start = center + factor * (start - center);
  end = center + factor * (end - center);
}

void LatheSegment::move(LathePoint by) {
  start += by;
  end += by;
  center += by;
}

LatheCrossings crossings(const LatheSegment& segment, double x) {
  LatheCrossings found;
  const auto add = [&found](double z) { found.z[found.count++] = z; };
  const double from = segment.start.imag();
  const double to = segment.end.imag();
  if (!segment.is_arc()) {
    if (std::min(from, to) > x + same || std::max(from, to) < x - same) return found;
    if (std::abs(from - to) < same) {
      add(segment.start.real());
      add(segment.end.real());
    } else {
      add(segment.start.real() + (x - from) / (to - from) * std::real(segment.end - segment.start));
    }
    return found;
  }
  const double height = x - segment.center.imag();
  const double square = segment.radius() * segment.radius() - height * height;
  if (square < -same) return found;
  const double half_chord = std::sqrt(std::max(0.0, square));
  for (const double z : {segment.center.real() + half_chord, segment.center.real() - half_chord}) {
    if (within_arc(segment, {z, x})) add(z);
  }
  return found;
}

LathePoint LatheOrientation::to_program(LathePoint point) const {
  if (mirrored_x) point = std::conj(point);
  if (mirrored_z) point = -std::conj(point);
  return turned ? point * i : point;
}

void LatheContour::turn() {
  for (LatheSegment& segment : segments) {
    for (LathePoint* const point : {&segment.start, &segment.end, &segment.center}) *point *= -i;
  }
  orientation.turned = !orientation.turned;
}

void LatheContour::orient() {
  const LathePoint back = segments.front().end - segments.back().end;
  // If the contour ends at the height at which it begins, the way to the contour must fall.
  const bool rises_to_it = segments.front().end.imag() > segments.front().start.imag();
  const bool mirror_x = back.imag() > 0 || (back.imag() == 0 && rises_to_it);
  const bool mirror_z = back.real() < 0;
  for (LatheSegment& segment : segments) {
    for (LathePoint* const point : {&segment.start, &segment.end, &segment.center}) {
      if (mirror_x) *point = std::conj(*point);
      if (mirror_z) *point = -std::conj(*point);
    }
    if (segment.is_arc() && mirror_x != mirror_z) {
      segment.shape = segment.shape == Shape::clockwise ? Shape::counterclockwise : Shape::clockwise;
    }
  }
  orientation.mirrored_x = orientation.mirrored_x != mirror_x;
  orientation.mirrored_z = orientation.mirrored_z != mirror_z;
}

bool LatheContour::goes_one_way() const {
  return std::all_of(segments.begin(), segments.end(),
                     [](const LatheSegment& segment) { return segment.is_corner() || segment.goes_one_way(); });
}

LatheFault LatheContour::work_out_corners() {
  for (std::size_t at = 1; at + 1 < segments.size(); ++at) {
    if (!segments[at].is_corner()) continue;
    if (segments[at + 1].is_corner()) return LatheFault::corner;
    if (!work_out_corner(segments[at - 1], segments[at], segments[at + 1])) return LatheFault::corner;
  }
  std::erase_if(segments, [](const LatheSegment& segment) { return segment.is_corner(); });  // after the last one
  const LatheSegment first = segments.front();
  segments.erase(segments.begin());
  drop_small(segments);
  segments.insert(segments.begin(), first);
  return segments.size() < 2 ? LatheFault::vanished : LatheFault::none;
}

// If the way to the contour begins on the contour's side of its first point, that way is made parallel to X.
LatheFault LatheContour::check_one_way() {
  LatheSegment& first = segments.front();
  if (first.end.real() > first.start.real()) first.start.real(first.end.real());
  return goes_one_way() ? LatheFault::none : LatheFault::not_monotonic;
}

LatheFault LatheContour::offset(double distance) {
  LatheSegment first = segments.front();
  if (cross(segments.back().start - first.start, first.end - first.start) < 0) distance = -distance;
  segments.erase(segments.begin());
  // The steps are so small that no segment vanishes unnoticed within one.
  double left = std::abs(distance);
  for (int step = 0; left > 0; ++step) {
    double most = left;
    for (const LatheSegment& segment : segments) most = std::min(most, segment.extent() / 2);
    if (step > most_offset_steps || most <= 0) return LatheFault::vanished;
    if (const LatheFault fault = offset_a_little(distance < 0 ? -most : most); fault != LatheFault::none) return fault;
    left = most < left ? left - most : 0;
  }
  for (std::size_t at = 0; at + 1 < segments.size(); ++at) {
    meet(segments[at], segments[at + 1], (segments[at].end + segments[at + 1].start) / 2.0);
  }
  first.end = segments.front().start;
  segments.insert(segments.begin(), first);
  return LatheFault::none;
}

LatheFault LatheContour::offset_a_little(double distance) {
  for (LatheSegment& segment : segments) segment.offset(distance);
  drop_small(segments);
  if (segments.empty()) return LatheFault::vanished;
  close_gaps(distance);
  return join();
}

// Adds an arc about each outer corner: so the tool goes round it.
void LatheContour::close_gaps(double distance) {
  for (std::size_t at = 0; at + 1 < segments.size(); ++at) {
    LatheSegment before = segments[at];
    LatheSegment after = segments[at + 1];
    if (std::real(before.end - after.start) <= gap) continue;
    before.offset(-distance);
    after.offset(-distance);
    LatheSegment arc;
    arc.shape = distance > 0 ? Shape::counterclockwise : Shape::clockwise;
    arc.start = segments[at].end;
    arc.end = segments[at + 1].start;
    arc.center = (before.end + after.start) / 2.0;
    arc.line = before.line;
    segments.insert(segments.begin() + static_cast<std::ptrdiff_t>(at) + 1, arc);
    ++at;
  }
}

// Cuts or lengthens each segment to where it meets the next one. Segments that turn back or are too short are dropped.
LatheFault LatheContour::join() {
  for (std::size_t at = 0; at + 1 < segments.size(); ++at) {
    if (!segments[at].goes_one_way()) {
      const bool drop_before = at > 0 && segments[at].extent() >= segments[at - 1].extent();
      segments.erase(segments.begin() + static_cast<std::ptrdiff_t>(drop_before ? at - 1 : at));
      at = 0;
      if (segments.size() < 2) return LatheFault::vanished;
    }
    if (segments[at].extent() < small) {
      segments.erase(segments.begin() + static_cast<std::ptrdiff_t>(at));
      at = 0;
      if (segments.size() < 2) break;
      if (!meet(segments[0], segments[1])) return LatheFault::parallel;
      continue;
    }
    if (!meet(segments[at], segments[at + 1])) return LatheFault::parallel;
  }
  return LatheFault::none;
}

}  // namespace passo
