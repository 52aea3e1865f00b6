#include "spline_codes.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "passo/base/counted.hpp"
#include "passo/geometry/bezier.hpp"

namespace passo {
namespace {

using enum ModalGroup;
using operation::ControlPoint;

constexpr std::int32_t quadratic_order = 3;
constexpr std::int32_t cubic_order = 4;
constexpr std::int32_t highest_order = 10;

ControlPoint control_point(double x, double y, double weight = 1) {
  return {x, y, weight};
}

// By Simpson's rule, which is exact enough for a feed rate.
template <std::size_t degree>
double length_of(std::span<const ControlPoint> points) {
  typename Bezier<degree>::Control control;
  for (std::size_t i = 0; i <= degree; ++i) control[i] = {points[i].x, points[i].y, 0};
  const auto curve = Bezier<degree>::create(control);
  if (!curve) return 0;  // a point is too far away, which the path module reports
  constexpr int parts = 64;
  double sum = 0;
  for (int i = 0; i <= parts; ++i) {
    const int share = i == 0 || i == parts ? 1 : i % 2 == 1 ? 4 : 2;
    sum += share * length(curve->derivative(static_cast<double>(i) / parts));
  }
  return sum / (3 * parts);
}

}  // namespace

// The checks for both G5 and G5.1.
bool SplineCodes::check() {
  if (state_.modal[cutter_compensation] != code(40) || cutter_.leaving()) {
    return fail("gcode.spline-compensated", motion_span(), "a spline while the cutter's radius is compensated",
                "G40 and a straight move first, or lines and arcs");
  }
  if (state_.modal.plane() != Plane::xy) {
    return fail("gcode.spline-plane", motion_span(), "a spline outside the plane XY", "G17 first");
  }
  return check_axes();
}

bool SplineCodes::check_axes() {
  for (const Axis axis : all_axes) {
    const char letter = letter_of(axis);
    if (axis == Axis::x || axis == Axis::y || !words_.has(letter)) continue;
    return fail("gcode.spline-axis", words_.span(letter), fmt::format("{} in a spline, which lies in X and Y", letter),
                "X and Y only");
  }
  return true;
}

// Reports that one or both of two words that go together are missing.
bool SplineCodes::fail_pair(std::string_view name, char first, char second, FindingWords expected) {
  const char present = words_.has(first) ? first : second;
  const char missing = words_.has(first) ? second : first;
  if (!words_.has(present)) {
    return fail("gcode.missing-word", motion_span(), fmt::format("{} without {} and {}", name, first, second),
                std::move(expected));
  }
  return fail("gcode.missing-word", words_.span(present),
              fmt::format("{} with {} and without {}", name, present, missing), std::move(expected));
}

// I and J lead from the start to the second control point, P and Q from the end to the third.
bool SplineCodes::cubic() {
  const Point start = state_.position;
  const std::optional<PlanePoint> before = std::exchange(exit_, std::nullopt);
  if (!end_point(state_.position) || !check()) return false;
  const double unit = state_.length_unit();
  if (!words_.has('P') || !words_.has('Q')) {
    return fail_pair("G5", 'P', 'Q', "P and Q, the offset from the end to the control point before it");
  }
  PlanePoint entry{scaled_way(Axis::x, words_['I'] * unit), scaled_way(Axis::y, words_['J'] * unit)};
  if (!words_.has('I') || !words_.has('J')) {
    if (words_.has('I') || words_.has('J') || !before) {
      return fail_pair("G5", 'I', 'J',
                       "I and J, the offset from the start to the control point after it; both can be omitted if a G5 "
                       "continues in the direction of the previous G5");
    }
    entry = *before;
  }
  const PlanePoint exit{scaled_way(Axis::x, -words_['P'] * unit), scaled_way(Axis::y, -words_['Q'] * unit)};
  exit_ = exit;
  if (!check_feed()) return false;

  const Point& end = state_.position;
  const double x = start[Axis::x];
  const double y = start[Axis::y];
  points_ = {control_point(x, y), control_point(x + entry.first, y + entry.second),
             control_point(end[Axis::x] - exit.first, end[Axis::y] - exit.second),
             control_point(end[Axis::x], end[Axis::y])};
  if (state_.modal.inverse_time()) emit_inverse_time_feed(length_of<3>(points_), false);
  emit(operation::NurbsFeed{points_, cubic_order});
  return true;
}

bool SplineCodes::quadratic() {
  const Point start = state_.position;
  if (!end_point(state_.position) || !check()) return false;
  if (!words_.has('I') || !words_.has('J')) {
    return fail_pair("G5.1", 'I', 'J', "I and J, the offset from the start to the control point");
  }
  if (!check_feed()) return false;

  const Point& end = state_.position;
  const double unit = state_.length_unit();
  const double x = start[Axis::x];
  const double y = start[Axis::y];
  points_[0] = control_point(x, y);
  points_[1] = control_point(x + scaled_way(Axis::x, words_['I'] * unit), y + scaled_way(Axis::y, words_['J'] * unit));
  points_[2] = control_point(end[Axis::x], end[Axis::y]);
  const std::span<const ControlPoint> points(points_.data(), quadratic_order);
  if (state_.modal.inverse_time()) emit_inverse_time_feed(length_of<2>(points), false);
  emit(operation::NurbsFeed{points, quadratic_order});
  return true;
}

// G5.2. The first control point is the tool's position, where the curve begins.
bool SplineCodes::nurbs_point() {
  const bool first = !nurbs_.open;
  if (first) {
    nurbs_.points.clear();
    nurbs_.points.reserve(cubic_order);
    nurbs_.points.push_back(control_point(state_.position[Axis::x], state_.position[Axis::y]));
    nurbs_.order = quadratic_order;
    nurbs_.line = state_.line;
    nurbs_.wrong = false;
    nurbs_.open = true;
  }
  const bool good = check_nurbs() && add_nurbs_point(first);
  nurbs_.wrong = nurbs_.wrong || !good;
  return good;
}

bool SplineCodes::check_nurbs() {
  if (state_.modal[cutter_compensation] != code(40) || cutter_.leaving()) {
    return fail("gcode.spline-compensated", motion_span(), "a NURBS while the cutter's radius is compensated",
                "G40 and a straight move first, or lines and arcs");
  }
  std::int32_t order = 0;
  if (words_.has('L')) {
    if (!whole_word('L', quadratic_order, highest_order, order)) return false;
    nurbs_.order = std::max(nurbs_.order, order);
  }
  return check_axes() && check_nurbs_feed();
}

bool SplineCodes::check_nurbs_feed() {
  if (!state_.modal.inverse_time()) return check_feed();
  return fail("gcode.spline-inverse-time", motion_span(), "a NURBS in inverse time (G93)", "G94 or G95 first");
}

bool SplineCodes::add_nurbs_point(bool first) {
  if (words_.has('X') != words_.has('Y')) {
    return fail_pair("a control point", 'X', 'Y', "X and Y of each control point");
  }
  const bool has_place = words_.has('X');
  if (words_.has('P') && words_['P'] <= 0) {
    return fail("gcode.bad-weight", words_.span('P'), fmt::format("the weight is {}", plain_number(words_['P'])),
                "P above 0");
  }
  if (!has_place) {
    if (first) {
      if (words_.has('P')) nurbs_.points.front().weight = words_['P'];
      return true;
    }
    return fail("gcode.missing-axis", motion_span(), "a control point without X and Y",
                "X and Y; P without X and Y is only allowed in the first block of G5.2, as the weight of the start");
  }
  if (!words_.has('P')) {
    return fail("gcode.missing-word", motion_span(), "a control point without P", "P, its weight, above 0");
  }
  if (nurbs_.points.size() == OpenNurbs::most_points) {
    return fail("gcode.too-many-points", motion_span(),
                fmt::format("more than {} control points", OpenNurbs::most_points), "G5.3, and another G5.2");
  }
  Point place;
  if (!end_point(place)) return false;
  nurbs_.points.push_back(control_point(place[Axis::x], place[Axis::y], words_['P']));
  return true;
}

// G5.3: the tool goes along the curve. After G5.3 no motion code is active.
bool SplineCodes::end_nurbs() {
  state_.modal.set(motion, code(80));
  if (!nurbs_.open) {
    return fail("gcode.no-nurbs", motion_span(), "G5.3 without a preceding G5.2", "G5.2 and its control points first");
  }
  close_nurbs();
  if (nurbs_.wrong) return false;  // which was reported
  if (nurbs_.points.size() < static_cast<std::size_t>(nurbs_.order)) {
    return fail(
        "gcode.too-few-points", motion_span(),
        fmt::format("a NURBS of order {} with {}", nurbs_.order, counted(nurbs_.points.size(), "control point")),
        fmt::format("at least {}, including the start; a lower L needs fewer", nurbs_.order));
  }
  if (!check_nurbs_feed()) return false;
  emit(operation::NurbsFeed{nurbs_.points, nurbs_.order});
  return true;
}

void SplineCodes::close_nurbs() {
  nurbs_.open = false;
  state_.position[Axis::x] = nurbs_.points.back().x;
  state_.position[Axis::y] = nurbs_.points.back().y;
}

void SplineCodes::report_open_nurbs() {
  if (!nurbs_.open || nurbs_.wrong || reporter_.full()) return;
  reporter_.error("gcode.open-nurbs", {1, 1},
                  fmt::format("the program ends while the NURBS that begins in line {} is open", nurbs_.line),
                  "G5.3 before");
}

void SplineCodes::check_nurbs_is_closed() {
  const auto belongs = [](const CodeEntry& entry) {
    const bool ends = entry.number == code(2) || entry.number == code(30) || entry.number == code(60);
    const bool stops = entry.group == stopping && !ends;
    return entry.number == code(5, 2) || entry.number == code(5, 3) || stops ||
           (entry.group == non_modal && entry.number == code(4));
  };
  for (const ModalGroup group :
       {motion, non_modal, work_system, tool_length, cutter_compensation, tool_change, stopping}) {
    const CodeEntry* const entry = words_.code(group);
    if (entry == nullptr || belongs(*entry)) continue;
    if (!nurbs_.wrong) {
      reporter_.error("gcode.open-nurbs", words_.span(group),
                      fmt::format("{} while the NURBS that begins in line {} is open", spelling(*entry), nurbs_.line),
                      "G5.3 before");
    }
    close_nurbs();
    return;
  }
}

}  // namespace passo
