#include "rules.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <system_error>

#include "code_table.hpp"

#include "passo/base/read_double.hpp"

namespace passo {
namespace {

constexpr Rule table[] = {
    {"gcode.abort", "Passo, docs/gcode.md: Lines, comments, parameters"},
    {"gcode.ambiguous-word", "Passo, docs/gcode.md: Order in a block"},
    {"gcode.arc-after-compensation", "LinuxCNC manual, G-codes: G40 Compensation Off"},
    {"gcode.arc-radii-differ", "RS274/NGC 3.5.3.2, center format arc"},
    {"gcode.axis-conflict", "RS274/NGC 3.4, modal groups"},
    {"gcode.bad-angle", "LinuxCNC manual, M-codes: M19 Orient Spindle"},
    {"gcode.bad-character", "RS274/NGC 3.3, format of a line"},
    {"gcode.bad-contour", "LinuxCNC manual, G-codes: G71 G72 Lathe roughing cycles"},
    {"gcode.bad-o-word", "LinuxCNC manual, O Codes: Numbering"},
    {"gcode.bad-operand", "RS274/NGC 3.3.2.4, unary operation value"},
    {"gcode.bad-parameter-name", "LinuxCNC manual, G-code Overview: Named Parameters"},
    {"gcode.bad-parameter-number", "RS274/NGC 3.2.1, parameters"},
    {"gcode.bad-polar", "LinuxCNC manual, G-code Overview: Polar Coordinates"},
    {"gcode.bad-thread", "LinuxCNC manual, G-codes: G76 Threading Cycle"},
    {"gcode.bad-wait", "LinuxCNC manual, M-codes: M66 Wait on Input"},
    {"gcode.bad-weight", "LinuxCNC manual, G-codes: G5.2 G5.3 NURBS Block"},
    {"gcode.blank-in-number", "RS274/NGC 3.3, format of a line"},
    {"gcode.calls-too-deep", "Passo, docs/gcode.md: Limits"},
    {"gcode.change-macro", "Passo, docs/gcode.md: Machine"},
    {"gcode.collet-output", "Passo, docs/gcode.md: Machine"},
    {"gcode.cutter-compensation", "LinuxCNC manual, G-codes: G41, G42 Cutter Compensation"},
    {"gcode.cutter-entry", "LinuxCNC manual, Tool Compensation: Cutter Radius Compensation"},
    {"gcode.cutter-gouge", "LinuxCNC manual, Tool Compensation: Cutter Radius Compensation"},
    {"gcode.cutter-stop", "Passo, docs/gcode.md: Cutter compensation"},
    {"gcode.cycle-axis", "RS274/NGC 3.5.16, canned cycles"},
    {"gcode.cycle-compensation", "RS274/NGC 3.5.16, canned cycles"},
    {"gcode.cycle-inverse-time", "RS274/NGC 3.5.16, canned cycles"},
    {"gcode.cycle-spindle", "RS274/NGC 3.5.16, canned cycles"},
    {"gcode.division-by-zero", "RS274/NGC 3.3.2.3, expressions and binary operations"},
    {"gcode.endless-calls", "Passo, docs/gcode.md: Limits"},
    {"gcode.endless-cycle", "Passo, docs/gcode.md: Limits"},
    {"gcode.endless-loop", "Passo, docs/gcode.md: Limits"},
    {"gcode.expression-too-deep", "Passo, docs/gcode.md: Limits"},
    {"gcode.fanuc-macro", "LinuxCNC manual, O Codes: Numbering"},
    {"gcode.feed-before-units", "RS274/NGC 3.8, order of execution"},
    {"gcode.g0-with-home", "RS274/NGC 3.4, modal groups"},
    {"gcode.g53-incremental", "RS274/NGC 3.5.12, move in absolute coordinates"},
    {"gcode.g53-without-move", "RS274/NGC 3.5.12, move in absolute coordinates"},
    {"gcode.grbl-command", "Passo, docs/gcode.md: Differences from grbl"},
    {"gcode.hidden-comment", "RS274/NGC 3.3.5, item repeats"},
    {"gcode.hook", "Passo, docs/gcode.md: Machine"},
    {"gcode.impossible-arc", "RS274/NGC 3.5.3.1, radius format arc"},
    {"gcode.line-too-long", "Passo, docs/gcode.md: Limits"},
    {"gcode.macro-argument", "grblHAL, G65: macro call"},
    {"gcode.missing-axis", "RS274/NGC 3.5, G codes"},
    {"gcode.missing-center", "RS274/NGC 3.5.3, arc at feed rate"},
    {"gcode.missing-condition", "LinuxCNC manual, O Codes: Conditional, Looping, Repeat"},
    {"gcode.missing-feed", "RS274/NGC 3.7.1, set feed rate"},
    {"gcode.missing-motion", "RS274/NGC 3.3.7, commands and machine modes"},
    {"gcode.missing-speed", "LinuxCNC manual, G-codes: G93, G94, G95 Feed Rate Mode"},
    {"gcode.missing-tool", "RS274/NGC 3.7.3, select tool"},
    {"gcode.missing-value", "RS274/NGC 3.3.2, word"},
    {"gcode.missing-word", "RS274/NGC 3.5, G codes, and 3.6, input M codes"},
    {"gcode.mixed-arc", "RS274/NGC 3.5.3, arc at feed rate"},
    {"gcode.mixed-subs", "LinuxCNC manual, O Codes: Fanuc-Style Numbered Programs"},
    {"gcode.modal-conflict", "RS274/NGC 3.4, modal groups"},
    {"gcode.move-after-end", "RS274/NGC 3.1, overview"},
    {"gcode.negative-word", "RS274/NGC 3.5, G codes, and 3.7, other input codes"},
    {"gcode.nested-comment", "RS274/NGC 3.3.4, comments and messages"},
    {"gcode.nested-macro", "grblHAL, G66: modal macro call"},
    {"gcode.no-end", "RS274/NGC 3.1, overview"},
    {"gcode.no-hal", "LinuxCNC manual, G-code Overview: Predefined Named Parameters"},
    {"gcode.no-numbered-programs", "LinuxCNC manual, INI Configuration: RS274NGC Section"},
    {"gcode.no-nurbs", "LinuxCNC manual, G-codes: G5.2 G5.3 NURBS Block"},
    {"gcode.no-such-spindle", "LinuxCNC manual, M-codes: M3, M4, M5 Spindle Control"},
    {"gcode.no-tool-table", "LinuxCNC manual, G-codes: G43 Tool Length Offset"},
    {"gcode.not-whole", "RS274/NGC 3.3.2.1, number"},
    {"gcode.nothing-saved", "LinuxCNC manual, M-codes: M72 Restore Modal State"},
    {"gcode.nul-byte", "RS274/NGC 3.3, format of a line"},
    {"gcode.number-out-of-range", "Passo, docs/gcode.md: Limits"},
    {"gcode.open-nurbs", "LinuxCNC manual, G-codes: G5.2 G5.3 NURBS Block"},
    {"gcode.overflow", "Passo, docs/gcode.md: Limits"},
    {"gcode.peck-too-small", "Passo, docs/gcode.md: Limits"},
    {"gcode.probe-before", "LinuxCNC manual, G-codes: G38.n Straight Probe"},
    {"gcode.probe-mode", "RS274/NGC 3.5.9, straight probe"},
    {"gcode.probe-too-short", "RS274/NGC 3.5.9, straight probe"},
    {"gcode.probe-untouched", "LinuxCNC manual, G-codes: G38.n Straight Probe"},
    {"gcode.read-only-parameter", "LinuxCNC manual, G-code Overview: Parameters"},
    {"gcode.repeated-word", "RS274/NGC 3.3.5, item repeats"},
    {"gcode.retract-below-bottom", "RS274/NGC 3.5.16, canned cycles"},
    {"gcode.scale-axis", "grblHAL, G50 and G51: scaling"},
    {"gcode.scaled-motion", "grblHAL, G50 and G51: scaling"},
    {"gcode.spindle-off", "LinuxCNC manual, G-codes: G33 Spindle Synchronized Motion"},
    {"gcode.spline-axis", "LinuxCNC manual, G-codes: G5 Cubic Spline"},
    {"gcode.spline-compensated", "LinuxCNC manual, G-codes: G41, G42 Cutter Compensation"},
    {"gcode.spline-inverse-time", "LinuxCNC manual, G-codes: G5.2 G5.3 NURBS Block"},
    {"gcode.spline-plane", "LinuxCNC manual, G-codes: G5 Cubic Spline"},
    {"gcode.stray-o-word", "LinuxCNC manual, O Codes: Errors"},
    {"gcode.too-deep", "Passo, docs/gcode.md: Limits"},
    {"gcode.too-few-points", "LinuxCNC manual, G-codes: G5.2 G5.3 NURBS Block"},
    {"gcode.too-many-arguments", "LinuxCNC manual, O Codes: Subroutines"},
    {"gcode.too-many-points", "Passo, docs/gcode.md: Limits"},
    {"gcode.too-much-held", "Passo, docs/gcode.md: Limits"},
    {"gcode.tool-loaded", "LinuxCNC manual, G-codes: G10 L0 Reload Tool Table Data"},
    {"gcode.tool-not-measured", "Passo, docs/gcode.md: Machine"},
    {"gcode.unclosed-bracket", "RS274/NGC 3.3.2.3, expressions and binary operations"},
    {"gcode.unclosed-comment", "RS274/NGC 3.3.4, comments and messages"},
    {"gcode.unclosed-o-word", "LinuxCNC manual, O Codes: Use of O-codes"},
    {"gcode.uneven-scaling", "grblHAL, G50 and G51: scaling"},
    {"gcode.unexpected-text", "RS274/NGC 3.3, format of a line"},
    {"gcode.unknown-code", "RS274/NGC 3.5, G codes, and 3.6, input M codes"},
    {"gcode.unknown-function", "RS274/NGC 3.3.2.4, unary operation value"},
    {"gcode.unknown-parameter", "RS274/NGC 3.3.2.2, parameter value"},
    {"gcode.unknown-sub", "LinuxCNC manual, O Codes: Calling Files"},
    {"gcode.unknown-tool", "LinuxCNC manual, Tool Compensation: Tool Table"},
    {"gcode.unknown-word", "RS274/NGC 3.3.2, word"},
    {"gcode.unset-parameter", "RS274/NGC 3.2.1, parameters"},
    {"gcode.unused-feed", "RS274/NGC 3.5.19, set feed rate mode"},
    {"gcode.unused-in-contour", "LinuxCNC manual, G-codes: G71 G72 Lathe roughing cycles"},
    {"gcode.unused-word", "Passo, docs/gcode.md: Order in a block"},
    {"gcode.user-code", "LinuxCNC manual, M-codes: M100 - M199 User Defined Commands"},
    {"gcode.wrong-center", "RS274/NGC 3.5.3.2, center format arc"},
    {"gcode.wrong-plane", "LinuxCNC manual, G-codes: G71 G72 Lathe roughing cycles"},
    {"gcode.zero-arc", "RS274/NGC 3.5.3, arc at feed rate"},
    {"gcode.zero-scale", "grblHAL, G50 and G51: scaling"},
    {"gcode.zero-tool-radius", "LinuxCNC manual, Tool Compensation: Cutter Radius Compensation"},
    {"parameters.bad-number", "LinuxCNC manual, G-code Overview: Parameters"},
    {"parameters.bad-value", "LinuxCNC manual, G-code Overview: Parameters"},
    {"parameters.repeated", "LinuxCNC manual, G-code Overview: Parameters"},
    {"settings.bad-line", "LinuxCNC manual, INI Configuration: The INI File Components"},
    {"settings.bad-section", "LinuxCNC manual, INI Configuration: The INI File Components"},
    {"settings.not-followed", "LinuxCNC manual, INI Configuration: RS274NGC, TRAJ and EMCIO Sections"},
    {"settings.too-many", "Passo, docs/gcode.md: Files of the machine"},
    {"tools.bad-number", "LinuxCNC manual, Tool Compensation: Tool Table Format"},
    {"tools.missing-number", "LinuxCNC manual, Tool Compensation: Tool Table Format"},
    {"tools.not-whole", "LinuxCNC manual, Tool Compensation: Tool Table Format"},
    {"tools.repeated-tool", "LinuxCNC manual, Tool Compensation: Tool Table Format"},
    {"tools.repeated-word", "LinuxCNC manual, Tool Compensation: Tool Table Format"},
    {"tools.too-many", "Passo, docs/gcode.md: Files of the machine"},
    {"tools.unknown-word", "LinuxCNC manual, Tool Compensation: Tool Table Format"},
};
static_assert(std::ranges::is_sorted(table, {}, &Rule::code));

// Mistakes in how a G or M code is used. For these the chapter of the G or M code says more than the chapter of the
// mistake.
constexpr std::string_view about_a_code[] = {
    "gcode.cycle-axis",      "gcode.cycle-compensation", "gcode.cycle-inverse-time", "gcode.cycle-spindle",
    "gcode.missing-axis",    "gcode.missing-feed",       "gcode.missing-word",       "gcode.probe-mode",
    "gcode.probe-too-short", "gcode.spindle-off",        "gcode.spline-axis",        "gcode.spline-inverse-time",
    "gcode.spline-plane",    "gcode.wrong-plane"};

// The chapter of the G or M code at the place of the diagnostic, as "G05.1". Empty: there is no such chapter.
std::string_view chapter_of_the_code(const Diagnostic& diagnostic) {
  const SourceLocation& place = diagnostic.place;
  if (place.column == 0 || place.column > diagnostic.text.size()) return {};
  const std::string_view word = std::string_view(diagnostic.text).substr(place.column - 1, place.length);
  double number = 0;
  const auto [end, problem] = read_double(word.data() + 1, word.data() + word.size(), number);
  if (problem != std::errc() || end != word.data() + word.size() || !(std::abs(number) < 1000)) return {};
  const char letter = word[0] == 'g' ? 'G' : word[0] == 'm' ? 'M' : word[0];
  const CodeEntry* const entry = find_code(letter, static_cast<CodeNumber>(std::lround(number * 10)));
  return entry == nullptr ? std::string_view() : entry->chapter;
}

}  // namespace

std::span<const Rule> rules() {
  return table;
}

std::string rule_of(const Diagnostic& diagnostic) {
  const std::string_view code = diagnostic.code;
  if (std::ranges::find(about_a_code, code) != std::end(about_a_code)) {
    const std::string_view chapter = chapter_of_the_code(diagnostic);
    if (!chapter.empty()) return std::string(chapter);
  }
  const auto* const found = std::ranges::lower_bound(table, code, {}, &Rule::code);
  return found != std::end(table) && found->code == code ? std::string(found->chapter) : std::string();
}

}  // namespace passo
