// Executor: what moves. G0 to G3, G33.
#include <cmath>
#include <numbers>

#include "executor.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

struct PlaneAxes {
  Axis first;
  Axis second;
  Axis through;
  char first_center;  // the letter of the centre's word
  char second_center;
  char through_center;
};
constexpr PlaneAxes plane_axes(Plane plane) {
  switch (plane) {
    case Plane::xy: return {Axis::x, Axis::y, Axis::z, 'I', 'J', 'K'};
    case Plane::zx: return {Axis::z, Axis::x, Axis::y, 'K', 'I', 'J'};
    case Plane::yz: break;
  }
  return {Axis::y, Axis::z, Axis::x, 'J', 'K', 'I'};
}

// The length that the feed counts: X Y Z if any of them moves, else U V W, else the angles.
double feed_length(const Point& from, const Point& to) {
  const auto length = [&](Axis a, Axis b, Axis c) {
    return std::hypot(to[a] - from[a], to[b] - from[b], to[c] - from[c]);
  };
  const double xyz = length(Axis::x, Axis::y, Axis::z);
  if (xyz > 0) return xyz;
  const double uvw = length(Axis::u, Axis::v, Axis::w);
  return uvw > 0 ? uvw : length(Axis::a, Axis::b, Axis::c);
}

}  // namespace

bool Executor::motion(BlockWords& words) {
  const CodeWord& code = words.code(ModalGroup::motion);
  if (code.is(800)) {
    state_.motion.reset();
    return true;
  }
  if (code) state_.motion = code.code->number;
  // Words that an offset or a homing code has taken are not a move's.
  const CodeWord& other = words.code(ModalGroup::non_modal);
  const bool taken = other && !other.is(530) && !other.is(40);
  const bool moves = !taken && words.has_axis_word();
  const bool arc_again = !taken && state_.motion && (*state_.motion == 20 || *state_.motion == 30) &&
                         (words.has('I') || words.has('J') || words.has('K') || words.has('R'));
  if (code && taken && !other.is(921) && !other.is(922) && !other.is(923)) {
    return reporter_.error("gcode.two-uses-of-axes", code.span, "the axis words belong to another code of this block",
                           "two blocks");
  }
  if (!moves && !arc_again) {
    if (other.is(530) && !code) {
      return reporter_.error("gcode.missing-value", other.span, "G53 has nothing to move", "G0 or G1, and an axis");
    }
    return !code || code.is(0) || code.is(10) ||
           reporter_.error("gcode.missing-value", code.span, "the move says no axis", "at least one axis word");
  }
  if (!state_.motion) {
    return reporter_.error("gcode.no-motion-mode", words.first(), "no motion mode is active",
                           "G0, G1, G2 or G3 in this block or before it");
  }
  switch (*state_.motion) {
    case 0: return straight(words, true);
    case 10: return straight(words, false);
    case 20: return arc(words, true);
    case 30: return arc(words, false);
    default: return synchronised(words);
  }
}

// @ and ^ in the place of X and Y: distance and angle from the work zero. In incremental mode they add to those of the
// tool's place; one that is missing stays as it is.
bool Executor::polar_point(const BlockWords& words, Point& end) const {
  if (!words.has_polar()) return true;
  if (state_.plane != Plane::xy || words.has('X') || words.has('Y')) {
    return reporter_.error("gcode.bad-combination", words.first(), "@ and ^ stand for X and Y, in the plane XY",
                           "G17, and neither X nor Y beside them");
  }
  constexpr double radians = std::numbers::pi / 180;
  const double radius = std::hypot(state_.work[Axis::x], state_.work[Axis::y]);
  const double angle = std::atan2(state_.work[Axis::y], state_.work[Axis::x]) / radians;
  const auto changed = [this](double now, const std::optional<double>& word, double scale) {
    return word ? *word * scale + (state_.incremental ? now : 0) : now;
  };
  const double new_radius = changed(radius, words.polar_radius(), state_.scale());
  const double new_angle = changed(angle, words.polar_angle(), 1) * radians;
  end[Axis::x] = new_radius * std::cos(new_angle);
  end[Axis::y] = new_radius * std::sin(new_angle);
  return true;
}

bool Executor::end_point(BlockWords& words, Point& end) {
  const bool machine = words.code(ModalGroup::non_modal).is(530);
  if (machine && state_.motion != 0 && state_.motion != 10) {
    return reporter_.error("gcode.bad-combination", words.code(ModalGroup::non_modal).span,
                           "G53 goes with G0 and G1 only", "G0 or G1");
  }
  end = machine ? state_.frame.machine_from_work(state_.work) : state_.work;
  for (const Axis axis : all_axes) {
    if (!words.has(letter_of(axis))) continue;
    const double diameter = axis == Axis::x && state_.diameters ? 0.5 : 1;
    const double value = words.take(letter_of(axis)) * (is_rotary(axis) ? 1 : state_.scale() * diameter);
    end[axis] = state_.incremental && !machine ? end[axis] + value : value;
  }
  if (machine) end = state_.frame.work_from_machine(end);
  return polar_point(words, end);
}

bool Executor::feed_is_set(BlockWords& words) {
  if (state_.feed_mode == FeedMode::inverse_time) {
    return words.has('F') || reporter_.error("gcode.missing-feed", words.first(), "this move has no F",
                                             "in inverse time mode (G93) an F on each feed move");
  }
  return state_.feed_rate > 0 || reporter_.error("gcode.missing-feed", words.first(), "no feed rate is set",
                                                 "F with a positive number in this block or before it");
}

void Executor::inverse_time(BlockWords& words, double length) {
  if (state_.feed_mode != FeedMode::inverse_time) return;
  emit(operation::SetFeedRate{length * words.take('F') / seconds_per_minute});
}

bool Executor::straight(BlockWords& words, bool rapid) {
  Point end;
  if (!end_point(words, end)) return false;
  if (rapid) {
    emit(operation::StraightTraverse{end});
  } else {
    if (!feed_is_set(words)) return false;
    inverse_time(words, feed_length(state_.work, end));
    emit(operation::StraightFeed{end});
  }
  state_.work = end;
  return true;
}

bool Executor::arc_center(BlockWords& words, const Point& end, bool clockwise, PlanePoint& center) {
  const PlaneAxes axes = plane_axes(state_.plane);
  const PlanePoint from{state_.work[axes.first], state_.work[axes.second]};
  const PlanePoint to{end[axes.first], end[axes.second]};
  const ArcTolerance tolerance = arc_tolerance(state_.units);
  const double scale = 1 / state_.scale();

  if (words.has('R')) {
    const double radius = length_word(words, 'R');
    if (std::hypot(to.first - from.first, to.second - from.second) < tolerance.least_radius) {
      return reporter_.error("gcode.arc-without-end", words.span('R'),
                             "with R the arc must end elsewhere than it begins", "a centre (I J K) for a full circle");
    }
    if (center_from_radius(from, to, radius, clockwise, tolerance, center)) return true;
    const double least = std::hypot(to.first - from.first, to.second - from.second) / 2;
    return reporter_.error("gcode.arc-radius-too-small", words.span('R'),
                           fmt::format("a radius of {:.6g} does not reach the end", std::fabs(radius) * scale),
                           fmt::format("R of at least {:.6g}", least * scale));
  }
  if (words.has(axes.through_center)) {
    return reporter_.error("gcode.unused-word", words.span(axes.through_center),
                           fmt::format("{} is no word of an arc in this plane", axes.through_center),
                           fmt::format("{} and {}", axes.first_center, axes.second_center));
  }
  const bool absolute = state_.arc_centers_absolute;
  const bool both = words.has(axes.first_center) && words.has(axes.second_center);
  const bool any = words.has(axes.first_center) || words.has(axes.second_center);
  if (!any || (absolute && !both)) {
    return reporter_.error(
        "gcode.arc-without-center", words.first(), "the arc has no centre",
        fmt::format("{} {} {}, or R", axes.first_center, absolute ? "and" : "or", axes.second_center));
  }
  center = {length_word(words, axes.first_center), length_word(words, axes.second_center)};
  if (!absolute) center = {center.first + from.first, center.second + from.second};
  const CenterCheck check = check_center(from, to, center, tolerance);
  if (check.good) return true;
  return reporter_.error("gcode.arc-radius-differs", words.first(),
                         fmt::format("the radius at the end is {:.6g}, at the start {:.6g}", check.end_radius * scale,
                                     check.start_radius * scale),
                         "a centre that is as far from the end as from the start");
}

bool Executor::arc(BlockWords& words, bool clockwise) {
  const PlaneAxes axes = plane_axes(state_.plane);
  Point end;
  PlanePoint center;
  if (!end_point(words, end)) return false;
  if (!arc_center(words, end, clockwise, center)) return false;
  const double turns = words.take_if('P').value_or(1);
  if (turns < 1 || turns > 1e6 || std::fabs(turns - std::round(turns)) > whole_number_tolerance) {
    return reporter_.error("gcode.value-out-of-range", words.span('P'), "P is no number of turns",
                           "a whole number from 1");
  }
  if (!feed_is_set(words)) return false;
  const auto whole_turns = static_cast<std::int32_t>(std::lround(turns));
  const PlanePoint from{state_.work[axes.first], state_.work[axes.second]};
  const PlanePoint to{end[axes.first], end[axes.second]};
  const double radius = std::hypot(from.first - center.first, from.second - center.second);
  const double angle = swept_angle(from, to, center, clockwise, whole_turns);
  inverse_time(words, std::hypot(radius * angle, end[axes.through] - state_.work[axes.through]));
  emit(operation::ArcFeed{.plane = state_.plane,
                          .end = end,
                          .first_center = Mm(center.first),
                          .second_center = Mm(center.second),
                          .turns = clockwise ? -whole_turns : whole_turns});
  state_.work = end;
  return true;
}

// G33: feed by the turning spindle. G33.1 goes back as well, as a rigid tap does.
bool Executor::synchronised(BlockWords& words) {
  const bool tapping = state_.motion == 331;
  const Point start = state_.work;
  Point end;
  if (!end_point(words, end)) return false;
  const Span span = words.code(ModalGroup::motion).span;
  if (!words.has('K') || words.peek('K') <= 0) {
    return reporter_.error("gcode.missing-value", words.has('K') ? words.span('K') : words.first(),
                           "a spindle-synchronised move needs its pitch", "K above zero: the way a revolution");
  }
  if (state_.spindle == SpindleDirection::off || state_.spindle_speed <= 0) {
    return reporter_.error("gcode.spindle-off", span, "the spindle does not turn", "M3 or M4, and S, before it");
  }
  emit(operation::StartSpeedFeedSync{.pitch = Mm(length_word(words, 'K'))});
  emit(operation::StraightFeed{end});
  if (tapping) {
    emit(operation::StraightFeed{start});
    end = start;
  }
  emit(operation::StopSpeedFeedSync{});
  state_.work = end;
  return true;
}

}  // namespace passo
