#include "code_family.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "interpreter_sentences.hpp"
#include "whole_number.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

using enum ModalGroup;

constexpr double feed_of_no_way = 0.1;  // units a minute: in inverse time, of a move that leads nowhere
constexpr int every_spindle = -1;

}  // namespace

bool CodeFamily::fail(std::string_view code, Span span, FindingWords message, FindingWords expected) {
  reporter_.error(code, span, std::move(message), std::move(expected));
  return false;
}

bool CodeFamily::whole_word(char letter, double lowest, double highest, std::int32_t& value) {
  const double number = words_[letter];
  const std::optional<double> whole = whole_within(number, lowest, highest);
  if (!whole) {
    return fail("gcode.not-whole", words_.span(letter),
                is_whole(number) ? fmt::format("{} is {}, outside {} to {}", letter, plain_number(number),
                                               plain_number(lowest), plain_number(highest))
                                 : fmt::format("{} is {}, which is not a whole number", letter, plain_number(number)),
                fmt::format("a whole number, {} to {}", plain_number(lowest), plain_number(highest)));
  }
  value = static_cast<std::int32_t>(*whole);
  return true;
}

Span CodeFamily::motion_span() const {
  if (words_.code(motion) != nullptr) return words_.span(motion);
  for (const Word& word : reporter_.block().words) {
    if ((axis_letters | polar_letters | LetterSet("IJK")).has(word.letter) && word.letter != 'G' &&
        word.letter != 'M') {
      return word.span;
    }
  }
  return {1, 1};
}

// The words that a code takes. Those of G10 depend on its L. grbl's arcs make no turns (P), and have a radius or a
// centre.
LetterSet CodeFamily::letters_of(const CodeEntry& entry) const {
  if (speaks_grbl() && entry.group == motion && (entry.number == code(2) || entry.number == code(3))) {
    return words_.has('R') ? "R" : "IJK";
  }
  if (entry.group != non_modal || entry.number != code(10) || !words_.has('L')) return entry.letters;
  if (words_['L'] == 2) return "LPR";
  return words_['L'] == 20 || words_['L'] == 0 ? "LP" : entry.letters;
}

double CodeFamily::diameter_factor(Axis axis) const {
  return axis == Axis::x && state_.modal[lathe_diameter] == code(7) ? 0.5 : 1;
}

bool CodeFamily::end_point(Point& end) {
  end = state_.position;
  if (words_.has_code(non_modal, code(53))) return machine_end_point(end);
  const bool incremental = state_.modal.incremental();
  for (const Axis axis : all_axes) {
    if (!words_.has(letter_of(axis))) continue;
    end[axis] = incremental ? end[axis] + scaled_way(axis, axis_word(axis)) : scaled_place(axis, axis_word(axis));
  }
  return !(words_.present() & polar_letters).any() || apply_polar(end);
}

bool CodeFamily::machine_end_point(Point& end) {
  if (state_.modal.incremental() && !speaks_grbl()) {
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
  // An axis that is not named keeps its value bit for bit. In a turned frame X and Y change together.
  const bool turned = state_.frame.rotation_degrees() != 0 && (words_.has('X') || words_.has('Y'));
  for (const Axis axis : all_axes) {
    if (words_.has(letter_of(axis)) || (turned && (axis == Axis::x || axis == Axis::y))) end[axis] = work[axis];
  }
  return true;
}

// @ is a distance from the origin, and ^ is an angle about it. If one is not given, it keeps its value.
bool CodeFamily::apply_polar(Point& end) {
  const char letter = words_.has('@') ? '@' : '^';
  if (state_.modal.plane() != Plane::xy) {
    return fail("gcode.bad-polar", words_.span(letter), "polar coordinates outside the plane XY", "G17 first");
  }
  for (const char beside : {'X', 'Y'}) {
    if (!words_.has(beside)) continue;
    return fail("gcode.bad-polar", words_.span(letter),
                fmt::format("{} and {} in one block: both set the position in X and Y", letter, beside),
                "@ and ^, or X and Y");
  }
  const double x = end[Axis::x];
  const double y = end[Axis::y];
  double radius = std::hypot(x, y);
  double angle = std::atan2(y, x);
  const bool incremental = state_.modal.incremental();
  if (radius == 0 && (incremental || !words_.has('^'))) {
    return fail_at_origin(letter);
  }
  if (words_.has('@')) radius = words_['@'] * state_.length_unit() + (incremental ? radius : 0);
  if (words_.has('^')) angle = words_['^'] * (std::numbers::pi / 180) + (incremental ? angle : 0);
  end[Axis::x] = radius * std::cos(angle);
  end[Axis::y] = radius * std::sin(angle);
  return true;
}

bool CodeFamily::check_feed() {
  if (state_.modal.inverse_time()) {
    if (words_.has('F') && words_['F'] > 0) return true;
    return fail("gcode.missing-feed", motion_span(), "a feed move in inverse time (G93) without its own F",
                "F in each block with a feed move, or G94");
  }
  if (state_.feed <= 0) {
    if (std::exchange(block_.missing_feed_told, true)) return false;  // reported once, not at every move
    return fail("gcode.missing-feed", motion_span(), interpreter_says::no_feed, interpreter_says::feed_first);
  }
  if (state_.modal.per_revolution() && state_.spindles[0].speed == 0) {
    return fail("gcode.missing-speed", motion_span(), "feed per revolution (G95) without a spindle speed",
                "S in this block or earlier");
  }
  return true;
}

void CodeFamily::emit_inverse_time_feed(double length, bool rotary) {
  const double units = rotary ? length : length / state_.length_unit();
  const double feed = units * words_['F'];
  emit_feed_rate(feed > 0 ? feed : feed_of_no_way);
}

void CodeFamily::emit_feed_rate(double units) {
  const double linear = units * state_.length_unit();
  if (state_.modal.per_revolution())
    return emit(operation::SetFeedRate{operation::FeedPerRevolution{Mm(linear), units}});
  emit(operation::SetFeedRate{operation::FeedPerSecond{MmPerSecond(linear / seconds_per_minute),
                                                       units / seconds_per_minute, state_.modal.inverse_time()}});
}

// The range is one spindle, or with $-1 all spindles if the code allows that. Without `$` it is spindle 0.
bool CodeFamily::spindle_word(SpindleChoice choice, SpindleRange& range) {
  range = {0, 1};
  if (!words_.has('$')) return true;
  const int lowest = choice == SpindleChoice::one_or_all ? every_spindle : 0;
  const int highest = state_.spindle_count - 1;
  const double number = words_['$'];
  if (number != std::round(number) || number < lowest || number > highest) {
    return fail("gcode.no-such-spindle", words_.span('$'), fmt::format("there is no spindle {}", plain_number(number)),
                highest == 0 ? std::string("$0: the machine has one spindle")
                             : fmt::format("$0 to ${}{}", highest, lowest < 0 ? ", or $-1 for all" : ""));
  }
  const auto spindle = static_cast<int>(number);
  range = spindle == every_spindle
              ? SpindleRange{0, static_cast<std::uint8_t>(state_.spindle_count)}
              : SpindleRange{static_cast<std::uint8_t>(spindle), static_cast<std::uint8_t>(spindle + 1)};
  return true;
}

bool CodeFamily::starts_in_doubt() const {
  const LetterSet doubtful = reporter_.doubts().axes();
  if (!doubtful.any()) return false;
  // In increments an arc is the same wherever it starts.
  const bool has_place = !words_.has('R') && state_.modal[ModalGroup::arc_distance] == code(90, 1);
  if (state_.modal.incremental() && !has_place) return false;
  const PlaneAxes axes = axes_of(state_.modal.plane());
  return doubtful.has(letter_of(axes.first)) || doubtful.has(letter_of(axes.second));
}

bool CodeFamily::report_arc(const ArcCenter& arc) {
  const double unit = state_.length_unit();
  if (arc.fault != ArcFault::none && starts_in_doubt()) {
    reporter_.meet_again();
    return false;
  }
  switch (arc.fault) {
    case ArcFault::none: return true;
    case ArcFault::zero_radius:
      return fail("gcode.zero-arc", motion_span(), interpreter_says::zero_arc, interpreter_says::some_radius);
    case ArcFault::radii_differ:
      return fail("gcode.arc-radii-differ", motion_span(),
                  interpreter_says::radii_differ.with({{"start", fmt::format("{:.4f}", arc.start_radius / unit)},
                                                       {"end", fmt::format("{:.4f}", arc.end_radius / unit)}}),
                  interpreter_says::equal_radii);
    case ArcFault::radius_too_small:
      return fail("gcode.impossible-arc", words_.span('R'),
                  interpreter_says::small_radius.with({{"radius", plain_number(words_['R'])}}),
                  interpreter_says::half_the_distance);
    case ArcFault::ends_at_start:
      return fail(speaks_grbl() ? "gcode.zero-arc" : "gcode.impossible-arc", words_.span('R'),
                  interpreter_says::ends_at_start, interpreter_says::full_circle);
  }
  return true;
}

bool CodeFamily::fail_at_origin(char letter) {
  return fail("gcode.bad-polar", words_.span(letter), "an incremental angle is not possible at the origin",
              "^ with @, in absolute distances (G90)");
}

}  // namespace passo
