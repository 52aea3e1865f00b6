#include "probe_codes.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include "interpreter_sentences.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

using enum ModalGroup;

double length_of_way(const Point& start, const Point& end) {
  return std::hypot(end[Axis::x] - start[Axis::x], end[Axis::y] - start[Axis::y], end[Axis::z] - start[Axis::z]);
}

// LinuxCNC's `rs274` ends a probe move this far (mm) before its end.
constexpr double preview_retract = 0.254;

constexpr bool is_toward(CodeNumber number) {
  return number == code(38, 2) || number == code(38, 3);
}
constexpr bool must_touch(CodeNumber number) {
  return number == code(38, 2) || number == code(38, 4);
}

}  // namespace

// G38.2 and G38.3 go on until the probe is touched, G38.4 and G38.5 until it is free. G38.3 and G38.5 need not succeed.
bool ProbeCodes::probe(CodeNumber number) {
  const Point start = state_.position;
  Point end;
  if (!end_point(end)) return false;
  state_.position = end;
  if (!check(number)) return false;
  if ((must_touch(number) || speaks_grbl()) && end == start) {
    return fail("gcode.probe-too-short", motion_span(), "the probe move has no length",
                "an end position in the direction of the probe move");
  }
  if (state_.modal.inverse_time()) emit_inverse_time_feed(length_of_way(start, end), false);
  emit(operation::TurnProbe{true});
  emit(operation::StraightProbe{end, is_toward(number), must_touch(number)});
  emit(operation::TurnProbe{false});
  if (block_.answers.probe() != nullptr) {
    awaited_ = number;
    return true;
  }
  keep_result(end, block_.options.on_machine);
  if (!block_.options.on_machine) state_.position = end - preview_backoff(start, end);
  return true;
}

// Called when the machine is at rest after the probe move. The program goes on from there, or ends.
void ProbeCodes::apply_outcome() {
  const CodeNumber number = *std::exchange(awaited_, std::nullopt);
  const ProbeOutcome& outcome = *block_.answers.probe();
  const std::string name = spelling('G', number);
  state_.position = state_.frame.work_from_machine(outcome.rest);
  keep_result(state_.frame.work_from_machine(outcome.contact), outcome.touched);
  if (outcome.refused) {
    block_.ended = true;
    fail(
        "gcode.probe-before", motion_span(),
        (is_toward(number) ? interpreter_says::triggered_before : interpreter_says::open_before).with({{"name", name}}),
        is_toward(number) ? "a move first, away from the surface that it touches"
                          : "the probe triggered before the move");
  } else if (!outcome.touched && must_touch(number)) {
    block_.ended = true;
    fail("gcode.probe-untouched", motion_span(),
         (is_toward(number) ? interpreter_says::still_open : interpreter_says::still_triggered).with({{"name", name}}),
         "a longer move, or G38.3 or G38.5, which continue, and a test of #5070");
  }
}

bool ProbeCodes::check(CodeNumber number) {
  const std::string name = spelling('G', number);
  if (state_.modal[cutter_compensation] != code(40)) {
    return fail("gcode.probe-mode", motion_span(), name + " while the cutter radius is compensated", "G40 first");
  }
  if ((state_.modal.inverse_time() && !speaks_grbl()) || state_.modal.per_revolution()) {
    return fail("gcode.probe-mode", motion_span(),
                fmt::format("{} in {}", name, state_.modal.inverse_time() ? "inverse time (G93)" : "G95"),
                "G94 and F first");
  }
  return check_feed();
}

// #5061 … get the place of contact, in the program's units and work coordinate system. #5070 tells whether the move
// succeeded.
void ProbeCodes::keep_result(const Point& place, bool touched) {
  for (const Axis axis : all_axes) {
    parameters_.set(probe_parameter + static_cast<int>(index_of(axis)), place[axis] / state_.units_of(axis));
  }
  parameters_.set(probe_success_parameter, touched ? 1 : 0);
}

Point ProbeCodes::preview_backoff(const Point& start, const Point& end) const {
  Point step;
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) step[axis] = end[axis] - start[axis];
  const double length = length_of_way(start, end);
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) step[axis] *= length > 0 ? preview_retract / length : 0;
  return step;
}

}  // namespace passo
