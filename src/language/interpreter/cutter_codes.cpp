#include "cutter_codes.hpp"

#include <cmath>
#include <variant>

#include "interpreter_sentences.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

using enum ModalGroup;

// Groups whose codes are forbidden during compensation. They would move the frame or the tool while it follows a
// contour, or they would act in the middle of moves that are held back.
struct Forbidden {
  ModalGroup group;
  bool before_g40;  // executed before the G40 of its own block
};
constexpr Forbidden forbidden[] = {
    {tool_change, true},  {overrides, true},  {input_output, true}, {plane, true},      {tool_length, false},
    {work_system, false}, {path_mode, false}, {retract, false},     {non_modal, false},
};

// Codes of those groups that are allowed all the same.
bool is_allowed(const CodeEntry& entry, const ModalState& modal) {
  if (entry.group == plane) return entry.number == modal[plane];
  return entry.group == non_modal && (entry.number == code(4) || entry.number == code(10));
}
// G70 is made of lines and arcs. G71 and G72 keep their distance from the contour themselves.
bool is_contour(CodeNumber motion_code) {
  return motion_code <= code(3) || motion_code == code(70) || motion_code == code(80);
}

}  // namespace

bool CutterCodes::check() {
  const CodeEntry* const switched = words_.code(cutter_compensation);
  const bool was_on = state_.modal[cutter_compensation] != code(40);
  const bool is_on = switched == nullptr ? was_on : switched->number != code(40);
  if (!was_on && !is_on) return true;
  if (!operations_.has_room()) {
    (void)cutter_.release();
    return fail("gcode.too-much-held", {1, 1}, "too many blocks between two moves with cutter compensation (G41, G42)",
                fmt::format("at most {} operations before the next move", OperationQueue::most_held));
  }
  constexpr const char* cure = "G40 in an earlier block";
  constexpr const char* with = "with cutter compensation on (G41, G42)";
  for (const Forbidden& group : forbidden) {
    const CodeEntry* const entry = words_.code(group.group);
    if (entry == nullptr || !(group.before_g40 ? was_on : is_on) || is_allowed(*entry, state_.modal)) continue;
    if (words_.has_code(non_modal, code(53)) && entry->group == non_modal && was_on && !cutter_.active()) continue;
    return fail("gcode.cutter-compensation", words_.span(group.group),
                fmt::format("{} ({}) {}", spelling(*entry), entry->what, with), cure);
  }
  if (is_on && words_.has_code(non_modal, code(10)) && words_.has('L') && words_.has('P') &&
      (words_['L'] == 2 || words_['L'] == 20) && (words_['P'] == 0 || words_['P'] == state_.frame.work_system())) {
    return fail("gcode.cutter-compensation", words_.span(non_modal),
                fmt::format("G10 changes the active work coordinate system {}", with), cure);
  }
  if (is_on && block_.motion != nullptr && !is_contour(block_.motion->number)) {
    return fail("gcode.cutter-compensation", motion_span(),
                fmt::format("{} ({}) {}", spelling(*block_.motion), block_.motion->what, with), cure);
  }
  return true;
}

bool CutterCodes::set(CodeNumber number) {
  if (number != code(40)) return start(number);
  emit_comment("interpreter: cutter radius compensation off");
  state_.modal.set(cutter_compensation, code(40));
  state_.cutter_shift = {};
  return report(cutter_.stop(), words_.span(cutter_compensation));
}

bool CutterCodes::start(CodeNumber number) {
  const Span span = words_.span(cutter_compensation);
  if (state_.modal.plane() != Plane::xy && state_.modal.plane() != Plane::zx) {
    return fail("gcode.cutter-compensation", span,
                fmt::format("cutter compensation in the plane of {}", spelling('G', state_.modal[plane])),
                "G17, or G18 on a lathe");
  }
  if (state_.modal[cutter_compensation] != code(40)) {
    return fail("gcode.cutter-compensation", span, "cutter compensation is already on", "G40 in an earlier block");
  }
  CutterSetup setup;
  setup.plane = state_.modal.plane();
  setup.left = number == code(41) || number == code(41, 1);
  const bool by_words = number == code(41, 1) || number == code(42, 1);
  if (!(by_words ? from_words(number, setup) : from_table(setup))) return false;
  if (setup.radius < 0) {  // the contour is drawn for a larger tool than this
    setup.left = !setup.left;
    setup.radius = -setup.radius;
  }
  emit_comment(setup.left ? "interpreter: cutter radius compensation on left"
                          : "interpreter: cutter radius compensation on right");
  state_.modal.set(cutter_compensation, setup.left ? code(41) : code(42));
  cutter_.start(setup);
  return true;
}

// G41.1 and G42.1: D is the diameter, and L on a lathe the orientation.
bool CutterCodes::from_words(CodeNumber number, CutterSetup& setup) {
  if (!words_.has('D')) {
    return fail("gcode.missing-word", words_.span(cutter_compensation),
                fmt::format("{} without D", spelling('G', number)), "D, the tool's diameter");
  }
  setup.radius = words_['D'] * state_.length_unit() / 2;
  if (!words_.has('L')) return true;
  std::int32_t orientation = 0;
  if (!whole_word('L', 0, highest_tool_orientation, orientation)) return false;
  setup.orientation = orientation;
  if (setup.plane == Plane::zx) return true;
  return fail("gcode.cutter-compensation", words_.span('L'),
              "L, the orientation of a lathe tool, is only allowed in the plane ZX", "G18 first, or no L");
}

// G41 and G42: D is a tool's number. Without D or with D0, the tool in the spindle counts.
bool CutterCodes::from_table(CutterSetup& setup) {
  const Tool* tool = &state_.spindle_tool;
  const Span span = words_.has('D') ? words_.span('D') : words_.span(cutter_compensation);
  std::int32_t number = 0;
  if (words_.has('D') && !whole_word('D', 0, highest_tool, number)) return false;
  if (number != 0) tool = state_.tools.find(number);
  if (tool == nullptr) {
    return fail(
        "gcode.unknown-tool", span, interpreter_says::tool_not_in_table.with({{"tool", std::to_string(number)}}),
        state_.tools.name.empty()
            ? "a tool table (--tools FILE), or G41.1 or G42.1 with the diameter"
            : "the number of a tool in the table, another table (--tools FILE), or G41.1 or G42.1 with the diameter");
  }
  setup.radius = tool->diameter.value() / 2;
  setup.orientation = tool->orientation;
  if (setup.radius == 0) {
    reporter_.warning("gcode.zero-tool-radius", span, "the tool's diameter is 0, so cutter compensation has no effect",
                      "a tool with a diameter in the tool table");
  }
  if (setup.plane == Plane::zx || setup.orientation == 0 || setup.orientation == highest_tool_orientation) return true;
  return fail("gcode.cutter-compensation", span, fmt::format("tool {} is a lathe tool", tool->number),
              "G18 (plane ZX) first");
}

bool CutterCodes::follow(const OperationKind& what) {
  const Point start = state_.position;
  const auto line = [&](bool rapid, const Point& end) {
    state_.position = end;
    return report(cutter_.line({rapid, start, end, kept_operation()}), motion_span());
  };
  if (const auto* const rapid = std::get_if<operation::StraightTraverse>(&what)) return line(true, rapid->end);
  if (const auto* const feed = std::get_if<operation::StraightFeed>(&what)) return line(false, feed->end);
  if (const auto* const arc = std::get_if<operation::ArcFeed>(&what)) {
    state_.position = arc->end;
    const PlanePoint center{arc->first_center.value(), arc->second_center.value()};
    return report(cutter_.arc({false, start, arc->end, kept_operation()}, center, arc->turns), motion_span());
  }
  emit(what);
  return true;
}

bool CutterCodes::report(CutterFault fault, Span span) {
  constexpr const char* smaller = "a smaller tool, or a contour with more room";
  const double radius = cutter_.radius() / state_.length_unit();
  const auto refuse = [&](std::string_view code, std::string message, const char* expected) {
    return fail(code, span, std::move(message), expected);
  };
  bool good = true;
  switch (fault) {
    case CutterFault::none: break;
    case CutterFault::entry_too_short:
      good = refuse("gcode.cutter-entry",
                    fmt::format("the first move with cutter compensation is not longer than the tool's radius of {}",
                                plain_number(radius)),
                    "a longer lead-in move in the plane, from outside the contour to its start");
      break;
    case CutterFault::entry_arc:
      good = refuse("gcode.cutter-entry",
                    "cutter compensation cannot start on this arc: no offset arc joins the tool's position to its end",
                    "a longer arc, or a straight lead-in move first");
      break;
    case CutterFault::arc_too_small:
      good =
          refuse("gcode.cutter-gouge",
                 fmt::format("the tool with a radius of {} does not fit into the arc", plain_number(radius)), smaller);
      break;
    case CutterFault::no_room:
      good = refuse("gcode.cutter-gouge",
                    fmt::format("the tool with a radius of {} does not fit into the corner before this move",
                                plain_number(radius)),
                    smaller);
      break;
    case CutterFault::unreachable:
      good = refuse("gcode.cutter-gouge",
                    fmt::format("the previous move is too short for the corners at its ends: a tool with a radius of "
                                "{} would cut into the contour",
                                plain_number(radius)),
                    smaller);
      break;
    case CutterFault::cut_corner:
      reporter_.warning("gcode.cutter-stop", span,
                        "the previous stop is in an inside corner, where the tool cuts into the contour",
                        "the stop at another point of the contour");
      break;
  }
  return good;
}

}  // namespace passo
