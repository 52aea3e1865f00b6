// BlockExecutor: the codes that move (modal group 1).
#include <cmath>
#include <numbers>

#include "block_executor.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

using enum ModalGroup;

constexpr double highest_turns = 1e6;
constexpr double slowest_inverse_time = 0.1;  // units a minute, as LinuxCNC bounds it

// The word that says where the centre is along an axis.
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

constexpr bool drills(CodeNumber number) {
  return number == code(73) || number == code(74) || (number > code(80) && number <= code(89));
}

struct FeedLength {
  double length = 0;
  bool rotary = false;
};
double norm(const Point& step, Axis first) {
  const std::size_t i = index_of(first);
  return std::hypot(step.values[i], step.values[i + 1], step.values[i + 2]);
}
// What the feed rate counts: X Y Z where they move, else U V W, else A B C.
FeedLength feed_length(const Point& step) {
  constexpr double still = 1e-7;
  if (const double length = norm(step, Axis::x); length > still) return {length, false};
  if (const double length = norm(step, Axis::u); length > still) return {length, false};
  return {norm(step, Axis::a), true};
}

}  // namespace

bool BlockExecutor::move(CodeNumber number) {
  if (!drills(number)) drilling_words_ = {};
  state_.modal.set(motion, number);
  const bool good = move_by(number);
  if (cutter_.active()) {
    if (!good) cutter_.skip_to(state_.position);
    state_.cutter_shift = cutter_.shift(state_.position);
  }
  return good;
}

bool BlockExecutor::move_by(CodeNumber number) {
  if (!check_scaling(number)) return false;
  if (number != code(5)) spline_exit_.reset();
  switch (number) {
    case code(0): return traverse();
    case code(1): return feed();
    case code(2): return arc(true);
    case code(3): return arc(false);
    case code(5): return cubic_spline();
    case code(5, 1): return quadratic_spline();
    case code(5, 2): return nurbs_point();
    case code(5, 3): return end_nurbs();
    case code(33): return threading(false);
    case code(33, 1): return threading(true);
    case code(38, 2):
    case code(38, 3):
    case code(38, 4):
    case code(38, 5): return probe(number);
    case code(73):
    case code(74):
    case code(81):
    case code(82):
    case code(83):
    case code(84):
    case code(85):
    case code(86):
    case code(87):
    case code(88):
    case code(89): return start_drilling(number);
    case code(76): return start_threading();
    case code(70):
    case code(71):
    case code(71, 1):
    case code(71, 2):
    case code(72):
    case code(72, 1):
    case code(72, 2): return start_lathe(number);
    default: note("interpreter: motion mode set to none"); return true;  // G80
  }
}

// A cycle feeds at units a minute or a revolution, along the programmed path.
bool BlockExecutor::check_cycle(std::string_view name) {
  if (!state_.modal.inverse_time()) return check_uncompensated(name);
  return fail("gcode.cycle-inverse-time", motion_span(), fmt::format("{} in inverse time feed (G93)", name),
              "G94 or G95 before");
}

bool BlockExecutor::check_uncompensated(std::string_view name) {
  if (state_.modal[cutter_compensation] == code(40)) return true;
  return fail("gcode.cycle-compensation", motion_span(), fmt::format("{} while cutter compensation is on", name),
              "G40 before");
}

double BlockExecutor::axis_word(Axis axis) const {
  const double value = words_[letter_of(axis)] * state_.units_of(axis);
  return axis == Axis::x && state_.modal.diameters() ? value / 2 : value;
}

// Where the block's axis words lead, in work coordinates.
bool BlockExecutor::end_point(Point& end) {
  end = state_.position;
  if (words_.has_code(non_modal, code(53))) return machine_end_point(end);
  const bool incremental = state_.modal.incremental();
  for (const Axis axis : all_axes) {
    if (!words_.has(letter_of(axis))) continue;
    end[axis] = incremental ? end[axis] + scaled_way(axis, axis_word(axis)) : scaled_place(axis, axis_word(axis));
  }
  return !(words_.present() & polar_letters).any() || apply_polar(end);
}

bool BlockExecutor::machine_end_point(Point& end) {
  if (state_.modal.incremental()) {
    return fail("gcode.g53-incremental", words_.span(non_modal), "G53 while distances are incremental (G91)",
                "G90 before G53, or in its block");
  }
  if ((words_.present() & polar_letters).any()) {
    return fail("gcode.bad-polar", motion_span(), "polar coordinates with G53", "X and Y");
  }
  Point machine = state_.machine_position();
  for (const Axis axis : all_axes) {
    if (words_.has(letter_of(axis))) machine[axis] = axis_word(axis);
  }
  const Point work = state_.frame.work_from_machine(machine);
  // An axis that is not named keeps its value bit for bit; in a turned frame X and Y go together.
  const bool turned = state_.frame.rotation_degrees() != 0 && (words_.has('X') || words_.has('Y'));
  for (const Axis axis : all_axes) {
    if (words_.has(letter_of(axis)) || (turned && (axis == Axis::x || axis == Axis::y))) end[axis] = work[axis];
  }
  return true;
}

// Without G51 bit for bit what the program says.
double BlockExecutor::scaled_place(Axis axis, double value) const {
  return state_.scaling.factor(axis) == 1 ? value : state_.scaling.place(axis, value);
}
double BlockExecutor::scaled_way(Axis axis, double value) const {
  return state_.scaling.way(axis, value);
}

// What cannot be scaled is refused: an arc would become an ellipse, and cycles are made of depths and retracts.
bool BlockExecutor::check_scaling(CodeNumber number) {
  if (!state_.scaling.on) return true;
  if (words_.has_code(non_modal, code(53))) return true;
  if ((words_.present() & polar_letters).any()) {
    return fail("gcode.scaled-motion", motion_span(), "polar coordinates while G51 scales", "G50 before, or X and Y");
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
              "G50 before");
}

// @ is a distance from the origin and ^ an angle about it; what is not given stays.
bool BlockExecutor::apply_polar(Point& end) {
  const char letter = words_.has('@') ? '@' : '^';
  if (state_.modal.plane() != Plane::xy || words_.has('X') || words_.has('Y')) {
    return fail("gcode.bad-polar", words_.span(letter), "polar coordinates outside the plane XY, or beside X and Y",
                "G17, and @ and ^ alone or with Z and others");
  }
  const double x = end[Axis::x];
  const double y = end[Axis::y];
  double radius = std::hypot(x, y);
  double angle = std::atan2(y, x);
  const bool incremental = state_.modal.incremental();
  if (radius == 0 && (incremental || !words_.has('^'))) {
    return fail("gcode.bad-polar", words_.span(letter), "at the origin there is no angle to go on from",
                "^ with @, in absolute distances (G90)");
  }
  if (words_.has('@')) radius = words_['@'] * state_.length_unit() + (incremental ? radius : 0);
  if (words_.has('^')) angle = words_['^'] * (std::numbers::pi / 180) + (incremental ? angle : 0);
  end[Axis::x] = radius * std::cos(angle);
  end[Axis::y] = radius * std::sin(angle);
  return true;
}

bool BlockExecutor::traverse() {
  const Point start = state_.position;
  return end_point(state_.position) && straight(true, start);
}

bool BlockExecutor::feed() {
  const Point start = state_.position;
  if (!end_point(state_.position) || !check_feed()) return false;
  if (state_.modal.inverse_time()) {
    const FeedLength counted = feed_length(state_.position - start);
    emit_inverse_time_feed(counted.length, counted.rotary);
  }
  return straight(false, start);
}

bool BlockExecutor::check_feed() {
  if (state_.modal.inverse_time()) {
    if (words_.has('F') && words_['F'] > 0) return true;
    return fail("gcode.missing-feed", motion_span(), "a feed move in inverse time (G93) without its own F",
                "F in each block with a feed move, or G94");
  }
  if (state_.feed <= 0) {
    if (std::exchange(missing_feed_told_, true)) return false;  // once, not at every move that follows
    return fail("gcode.missing-feed", motion_span(), "no feed rate is set",
                "F before the first feed move, or in its block");
  }
  if (state_.modal.per_revolution() && state_.spindles[0].speed == 0) {
    return fail("gcode.missing-speed", motion_span(), "a feed for each revolution (G95) and no spindle speed",
                "S before, or in this block");
  }
  return true;
}

void BlockExecutor::emit_inverse_time_feed(double length, bool rotary) {
  const double units = rotary ? length : length / state_.length_unit();
  emit_feed_rate(std::max(slowest_inverse_time, units * words_['F']));
}

bool BlockExecutor::arc(bool clockwise) {
  const Point start = state_.position;
  Point end;
  if (!end_point(end)) return false;
  state_.position = end;
  if (cutter_.leaving()) {
    return fail("gcode.arc-after-compensation", motion_span(), "an arc after cutter compensation ended (G40)",
                "a straight move first, which leads the tool to the contour");
  }
  const PlaneAxes plane_axes = axes_of(state_.modal.plane());
  if (is_of_uvw(state_.modal.plane())) {
    return fail("gcode.wrong-plane", motion_span(),
                fmt::format("an arc in the plane {}", name_of(state_.modal.plane())), "G17, G18 or G19 before");
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

bool BlockExecutor::find_arc_center(bool clockwise, const Point& end, ArcCenter& found) {
  const PlaneAxes plane_axes = axes_of(state_.modal.plane());
  const PlanePoint from{state_.position[plane_axes.first], state_.position[plane_axes.second]};
  const PlanePoint to{end[plane_axes.first], end[plane_axes.second]};
  const ArcTolerance& tolerance = state_.modal.inches() ? arc_tolerance_inch : arc_tolerance_mm;
  const bool by_center = (words_.present() & LetterSet("IJK")).any();

  if (by_center && words_.has('R')) {
    return fail("gcode.mixed-arc", words_.span('R'), "an arc with a radius and a centre", "R, or I J K");
  }
  if (words_.has('R')) {
    const double scale = std::abs(state_.scaling.factor(plane_axes.first));
    found = center_from_radius(from, to, words_['R'] * state_.length_unit() * scale, clockwise, tolerance);
  } else if (by_center) {
    PlanePoint center;
    if (!center_words(from, center)) return false;
    found = check_center(from, to, center, tolerance);
  } else {
    const std::string letters =
        fmt::format("{} and {}", center_letter(plane_axes.first), center_letter(plane_axes.second));
    return fail("gcode.missing-center", motion_span(), "an arc without a centre or a radius",
                fmt::format("{} (or one of them) for the centre in the plane {}, or R", letters,
                            name_of(state_.modal.plane())));
  }
  return report_arc(found);
}

// I J K: the centre's distance from the start, or with G90.1 where it is.
bool BlockExecutor::center_words(PlanePoint start, PlanePoint& center) {
  const PlaneAxes plane_axes = axes_of(state_.modal.plane());
  if (const char wrong = center_letter(plane_axes.normal); words_.has(wrong)) {
    return fail("gcode.wrong-center", words_.span(wrong),
                fmt::format("{} is not in the plane {}", wrong, name_of(state_.modal.plane())),
                fmt::format("{} and {}, or the plane's code before", center_letter(plane_axes.first),
                            center_letter(plane_axes.second)));
  }
  const bool absolute = state_.modal[arc_distance] == code(90, 1);
  const double unit = state_.length_unit();
  center = absolute ? PlanePoint{} : start;
  for (const auto& [axis, value] : {std::pair{plane_axes.first, &center.first}, {plane_axes.second, &center.second}}) {
    const char letter = center_letter(axis);
    if (words_.has(letter)) {
      const double word = words_[letter] * unit;
      *value = absolute ? scaled_place(axis, word) : *value + scaled_way(axis, word);
    } else if (absolute) {
      return fail("gcode.missing-center", motion_span(),
                  fmt::format("an arc with an absolute centre (G90.1) without {}", letter),
                  fmt::format("{} and {}", center_letter(plane_axes.first), center_letter(plane_axes.second)));
    }
  }
  return true;
}

bool BlockExecutor::arc_turns(std::int32_t& turns) {
  return !words_.has('P') || whole_word('P', 1, highest_turns, turns);
}

bool BlockExecutor::report_arc(const ArcCenter& arc) {
  const double unit = state_.length_unit();
  switch (arc.fault) {
    case ArcFault::none: return true;
    case ArcFault::zero_radius:
      return fail("gcode.zero-arc", motion_span(), "the arc's centre is its start or its end", "a radius above zero");
    case ArcFault::radii_differ:
      return fail("gcode.arc-radii-differ", motion_span(),
                  fmt::format("the arc starts at a radius of {:.4f} and ends at {:.4f}", arc.start_radius / unit,
                              arc.end_radius / unit),
                  "a centre as far from the start as from the end");
    case ArcFault::radius_too_small:
      return fail(
          "gcode.impossible-arc", words_.span('R'),
          fmt::format("no arc with a radius of {} reaches from the start to the end", plain_number(words_['R'])),
          "half the distance at least");
    case ArcFault::ends_at_start:
      return fail("gcode.impossible-arc", words_.span('R'), "an arc with R that ends where it starts",
                  "a full circle is written with I J K");
  }
  return true;
}

// G33 and G33.1: K is how far the tool goes in a revolution.
bool BlockExecutor::threading(bool tapping) {
  const char* const name = tapping ? "G33.1" : "G33";
  const Point start = state_.position;
  cutter_.left();
  if (!end_point(state_.position)) return false;
  if (!words_.has('K')) {
    return fail("gcode.missing-word", motion_span(), fmt::format("{} without K", name),
                "K, the length of one revolution");
  }
  if (words_.has('F')) {
    return fail("gcode.unused-word", words_.span('F'), fmt::format("F with {}, whose speed is the spindle's", name),
                "no F");
  }
  SpindleRange spindle;
  if (!spindle_word(SpindleChoice::one, spindle)) return false;
  if (state_.spindles[spindle.first].direction == SpindleDirection::off) {
    return fail("gcode.spindle-off", motion_span(), fmt::format("{} while the spindle does not turn", name),
                "M3 or M4 before, or in this block");
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

// What to point at when a motion is wrong: its code, or where it is modal the first word that made it move.
Span BlockExecutor::motion_span() const {
  if (words_.code(motion) != nullptr) return words_.span(motion);
  for (const Word& word : reporter_.block().words) {
    if ((axis_letters | polar_letters | LetterSet("IJK")).has(word.letter) && word.letter != 'G' &&
        word.letter != 'M') {
      return word.span;
    }
  }
  return {1, 1};
}

}  // namespace passo
