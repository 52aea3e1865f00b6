#include "motion_codes.hpp"

#include <cmath>
#include <numbers>

#include "interpreter_sentences.hpp"
#include <fmt/format.h>

#include "passo/interpreter/plane_axes.hpp"

namespace passo {
namespace {

using enum ModalGroup;

constexpr double highest_turns = 1e6;

// The letter of the word for the centre along this axis.
constexpr char center_letter(Axis axis) {
  return axis == Axis::x ? 'I' : axis == Axis::y ? 'J' : 'K';
}
constexpr std::string_view name_of(Plane plane) {
  switch (plane) {
    case Plane::xy: return "XY (G17)";
    case Plane::zx: return "ZX (G18)";
    case Plane::yz: return "YZ (G19)";
    case Plane::uv: return "UV (G17.1)";
    case Plane::wu: return "WU (G18.1)";
    case Plane::vw: return "VW (G19.1)";
  }
  return {};
}

struct FeedLength {
  double length = 0;
  bool rotary = false;
};
double norm(const Point& step, Axis first) {
  const std::size_t i = index_of(first);
  return std::hypot(step.values[i], step.values[i + 1], step.values[i + 2]);
}
// The length for which the feed rate counts: of X Y Z if they move, else of U V W if they move, else of A B C.
FeedLength feed_length(const Point& step) {
  constexpr double still = 1e-7;
  if (const double length = norm(step, Axis::x); length > still) return {length, false};
  if (const double length = norm(step, Axis::u); length > still) return {length, false};
  return {norm(step, Axis::a), true};
}

}  // namespace

// Refuses what cannot be scaled: polar words, an arc that would become an ellipse, probe moves, G33.1, and cycles,
// which are made of depths and retracts.
bool MotionCodes::check_scaling(CodeNumber number) {
  if (!state_.scaling.on) return true;
  if (words_.has_code(non_modal, code(53))) return true;
  if ((words_.present() & polar_letters).any()) {
    return fail("gcode.scaled-motion", motion_span(), "polar coordinates while G51 scales", "G50 first, or X and Y");
  }
  if (number == code(2) || number == code(3)) {
    const PlaneAxes plane_axes = axes_of(state_.modal.plane());
    const double first = state_.scaling.factor(plane_axes.first);
    const double second = state_.scaling.factor(plane_axes.second);
    if (first == second) return true;
    return fail("gcode.uneven-scaling", motion_span(),
                fmt::format("an arc while {} is scaled by {} and {} by {}", letter_of(plane_axes.first),
                            plain_number(first), letter_of(plane_axes.second), plain_number(second)),
                "the same factor for both axes of the plane (G51 P), or a spline, which may be stretched");
  }
  if (number <= code(5, 3) || number == code(33) || number == code(80)) return true;
  return fail("gcode.scaled-motion", motion_span(), fmt::format("{} while G51 scales", spelling('G', number)),
              "G50 first");
}

bool MotionCodes::traverse() {
  const Point start = state_.position;
  return end_point(state_.position) && straight(true, start);
}

bool MotionCodes::feed() {
  const Point start = state_.position;
  if (!end_point(state_.position) || !check_feed()) return false;
  if (state_.modal.inverse_time()) {
    const FeedLength counted = feed_length(state_.position - start);
    emit_inverse_time_feed(counted.length, counted.rotary);
  }
  return straight(false, start);
}

bool MotionCodes::arc(bool clockwise) {
  const Point start = state_.position;
  Point end;
  if (!end_point(end)) return false;
  state_.position = end;
  if (cutter_.leaving()) {
    return fail("gcode.arc-after-compensation", motion_span(), "an arc after cutter compensation ended (G40)",
                "a straight lead-out move first");
  }
  const PlaneAxes plane_axes = axes_of(state_.modal.plane());
  if (is_of_uvw(state_.modal.plane())) {
    return fail("gcode.wrong-plane", motion_span(),
                fmt::format("an arc in the plane {}", name_of(state_.modal.plane())), "G17, G18 or G19 first");
  }

  ArcCenter found;
  std::int32_t turns = 1;
  state_.position = start;
  const bool good = find_arc_center(clockwise, end, found) && arc_turns(turns);
  state_.position = end;
  if (!good || !check_feed()) return false;
  if (clockwise) turns = -turns;

  if (state_.modal.inverse_time()) {
    const PlanePoint from{start[plane_axes.first], start[plane_axes.second]};
    const PlanePoint to{end[plane_axes.first], end[plane_axes.second]};
    const double around = found.start_radius * arc_sweep(from, to, found.center, turns);
    emit_inverse_time_feed(std::hypot(around, end[plane_axes.normal] - start[plane_axes.normal]), false);
  }
  if (cutter_.active()) return arc_beside(start, found.center, turns);
  emit(operation::ArcFeed{state_.modal.plane(), end, Mm(found.center.first), Mm(found.center.second), turns});
  return true;
}

bool MotionCodes::find_arc_center(bool clockwise, const Point& end, ArcCenter& found) {
  const PlaneAxes plane_axes = axes_of(state_.modal.plane());
  const PlanePoint from{state_.position[plane_axes.first], state_.position[plane_axes.second]};
  const PlanePoint to{end[plane_axes.first], end[plane_axes.second]};
  const ArcTolerance& tolerance = speaks_grbl()           ? arc_tolerance_grbl
                                  : state_.modal.inches() ? arc_tolerance_inch
                                                          : arc_tolerance_mm;
  // In grbl R comes first. Which words of an arc have no use is looked at behind its place.
  const bool by_center = (words_.present() & LetterSet("IJK")).any() && !(speaks_grbl() && words_.has('R'));

  if (by_center && words_.has('R')) {
    return fail("gcode.mixed-arc", words_.span('R'), interpreter_says::radius_and_centre,
                interpreter_says::radius_or_centre);
  }
  if (words_.has('R')) {
    const double scale = std::abs(state_.scaling.factor(plane_axes.first));
    found = center_from_radius(from, to, words_['R'] * state_.length_unit() * scale, clockwise, tolerance);
  } else if (by_center) {
    PlanePoint center;
    if (!center_words(from, center)) return false;
    found = check_center(from, to, center, tolerance);
    if (found.fault == ArcFault::radii_differ && !starts_in_doubt() && fits_other_distance(from, to, tolerance)) {
      return false;
    }
  } else {
    const std::string letters =
        fmt::format("{} and {}", center_letter(plane_axes.first), center_letter(plane_axes.second));
    return fail("gcode.missing-center", motion_span(), interpreter_says::no_centre,
                interpreter_says::centre_words.with(
                    {{"letters", letters}, {"plane", std::string(name_of(state_.modal.plane()))}}));
  }
  return report_arc(found);
}

// I J K: the centre's distance from the start, or with G90.1 its position.
bool MotionCodes::center_words(PlanePoint start, PlanePoint& center) {
  const PlaneAxes plane_axes = axes_of(state_.modal.plane());
  if (const char wrong = center_letter(plane_axes.normal); words_.has(wrong)) {
    const SentenceRow& expected =
        words_[wrong] == 0 ? interpreter_says::words_in_plane_or_grbl : interpreter_says::words_in_plane;
    return fail("gcode.wrong-center", words_.span(wrong),
                interpreter_says::not_in_plane.with(
                    {{"letter", std::string(1, wrong)}, {"plane", std::string(name_of(state_.modal.plane()))}}),
                expected.with({{"first", std::string(1, center_letter(plane_axes.first))},
                               {"second", std::string(1, center_letter(plane_axes.second))}}));
  }
  const bool absolute = state_.modal[arc_distance] == code(90, 1);
  for (const char letter : {center_letter(plane_axes.first), center_letter(plane_axes.second)}) {
    if (!absolute || words_.has(letter)) continue;
    return fail("gcode.missing-center", motion_span(),
                fmt::format("an arc with an absolute centre (G90.1) without {}", letter),
                fmt::format("{} and {}", center_letter(plane_axes.first), center_letter(plane_axes.second)));
  }
  center = center_by_words(start, absolute);
  return true;
}

PlanePoint MotionCodes::center_by_words(PlanePoint start, bool absolute) const {
  const PlaneAxes plane_axes = axes_of(state_.modal.plane());
  PlanePoint center = absolute ? PlanePoint{} : start;
  for (const auto& [axis, value] : {std::pair{plane_axes.first, &center.first}, {plane_axes.second, &center.second}}) {
    const char letter = center_letter(axis);
    if (!words_.has(letter)) continue;
    const double word = words_[letter] * state_.length_unit();
    *value = absolute ? scaled_place(axis, word) : *value + scaled_way(axis, word);
  }
  return center;
}

// The commonest reason why radii differ: I J K are meant the other way. True: they are, and this is reported.
bool MotionCodes::fits_other_distance(PlanePoint from, PlanePoint to, const ArcTolerance& tolerance) {
  const bool absolute = state_.modal[arc_distance] == code(90, 1);
  if (check_center(from, to, center_by_words(from, !absolute), tolerance).fault != ArcFault::none) return false;
  fail("gcode.arc-radii-differ", motion_span(),
       absolute ? interpreter_says::not_absolute : interpreter_says::not_incremental,
       absolute ? interpreter_says::incremental_before : interpreter_says::absolute_before);
  return true;
}

bool MotionCodes::arc_turns(std::int32_t& turns) {
  return speaks_grbl() || !words_.has('P') || whole_word('P', 1, highest_turns, turns);
}

bool MotionCodes::straight(bool rapid, const Point& start) {
  cutter_.left();
  if (!cutter_.active()) {
    if (rapid) {
      emit(operation::StraightTraverse{state_.position});
    } else {
      emit(operation::StraightFeed{state_.position});
    }
    return true;
  }
  return cutter_codes_.report(cutter_.line({rapid, start, state_.position, kept_operation()}), motion_span());
}

bool MotionCodes::arc_beside(const Point& start, PlanePoint center, std::int32_t turns) {
  return cutter_codes_.report(cutter_.arc({false, start, state_.position, kept_operation()}, center, turns),
                              motion_span());
}

// G33 and G33.1: K is the tool's way in one revolution of the spindle.
bool MotionCodes::threading(bool tapping) {
  const char* const name = tapping ? "G33.1" : "G33";
  const Point start = state_.position;
  cutter_.left();
  if (!end_point(state_.position)) return false;
  if (!words_.has('K')) {
    return fail("gcode.missing-word", motion_span(), fmt::format("{} without K", name),
                "K, the length of one revolution");
  }
  if (words_.has('F')) {
    return fail("gcode.unused-word", words_.span('F'),
                fmt::format("F together with {}, whose speed follows from the spindle", name), "no F");
  }
  SpindleRange spindle;
  if (!spindle_word(SpindleChoice::one, spindle)) return false;
  if (state_.spindles[spindle.first].direction == SpindleDirection::off) {
    return fail("gcode.spindle-off", motion_span(), fmt::format("{} while the spindle does not turn", name),
                "M3 or M4 in this block or earlier");
  }
  emit(operation::StartSpeedFeedSync{Mm(words_['K'] * state_.length_unit()), false, spindle.first});
  if (tapping) {
    emit(operation::RigidTap{state_.position});
    state_.position = start;
  } else {
    emit(operation::StraightFeed{state_.position});
  }
  emit(operation::StopSpeedFeedSync{});
  return true;
}

}  // namespace passo
