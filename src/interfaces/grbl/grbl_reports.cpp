#include "passo/grbl/grbl_reports.hpp"

#include <cmath>

#include <fmt/format.h>

#include "passo/interpreter/saved_offsets.hpp"

namespace passo {
namespace {

constexpr int shown_systems = 6;
constexpr int first_home = 5161;
constexpr int second_home = 5181;

// No "-0.000".
double clean(double value, int decimals) {
  const double unit = std::pow(10, -decimals);
  return std::abs(value) < unit / 2 ? 0 : value;
}

double in_units(double value, Axis axis, const GrblUnits& units) {
  return units.inches && !is_rotary(axis) ? value / mm_per_inch : value;
}

std::string place_line(std::string_view name, const Point& place, const GrblUnits& units) {
  return fmt::format("[{}:{}]\r\n", name, places_text(place, units));
}

}  // namespace

std::string places_text(const Point& place, const GrblUnits& units) {
  const int decimals = units.inches ? 4 : 3;
  std::string text;
  for (const Axis axis : units.axes) {
    const double value = clean(in_units(place[axis], axis, units), decimals);
    text += fmt::format("{}{:.{}f}", text.empty() ? "" : ",", value, decimals);
  }
  return text;
}

std::string status_text(const GrblStatus& status, const GrblUnits& units, unsigned mask) {
  const bool machine_places = (mask & 1U) != 0;
  const Point shown = machine_places ? status.machine_place : status.machine_place - status.work_offset;
  std::string text =
      fmt::format("<{}|{}:{}", status.state, machine_places ? "MPos" : "WPos", places_text(shown, units));
  if ((mask & 2U) != 0) text += fmt::format("|Bf:{},{}", status.planner_free, status.bytes_free);
  if (status.line_number > 0) text += fmt::format("|Ln:{}", status.line_number);
  const double feed = units.inches ? status.feed / mm_per_inch : status.feed;
  text += fmt::format("|FS:{:.0f},{:.0f}", feed, status.speed);
  if (!status.pins.empty()) text += "|Pn:" + status.pins;
  if (status.shows_offset) text += "|WCO:" + places_text(status.work_offset, units);
  if (status.shows_overrides) {
    text += fmt::format("|Ov:{},{},{}", status.feed_override, status.rapid_override, status.spindle_override);
    std::string on;
    if (status.outputs.spindle == SpindleDirection::clockwise) on += 'S';
    if (status.outputs.spindle == SpindleDirection::counterclockwise) on += 'C';
    if (status.outputs.flood) on += 'F';
    if (status.outputs.mist) on += 'M';
    if (!on.empty()) text += "|A:" + on;
  }
  return text + ">\r\n";
}

std::string modes_text(const ActiveModes& modes, const GrblUnits& units) {
  std::string text = "[GC:";
  for (const std::string& code : modes.codes) text += code + " ";
  switch (modes.spindle) {
    case SpindleDirection::off: text += "M5"; break;
    case SpindleDirection::clockwise: text += "M3"; break;
    case SpindleDirection::counterclockwise: text += "M4"; break;
  }
  if (modes.mist) text += " M7";
  if (modes.flood) text += " M8";
  if (!modes.mist && !modes.flood) text += " M9";
  const double feed = units.inches ? modes.feed / mm_per_inch : modes.feed;
  return text +
         fmt::format(" T{} F{:.0f} S{:.0f}]\r\n", std::max(modes.tool, 0), std::round(feed), std::round(modes.speed));
}

std::string probe_text(const std::optional<ProbeOutcome>& probe, const GrblUnits& units) {
  const bool touched = probe && probe->touched;
  return fmt::format("[PRB:{}:{}]\r\n", places_text(touched ? probe->contact : Point(), units), touched ? 1 : 0);
}

std::string offsets_text(const SavedParameters& parameters, const ActiveModes& modes,
                         const std::optional<ProbeOutcome>& probe, const GrblUnits& units) {
  std::string text;
  for (int system = 1; system <= shown_systems; ++system) {
    text += place_line(name_of_system(system), saved_point(parameters, work_offset_parameter(system)), units);
  }
  text += place_line("G28", saved_point(parameters, first_home), units);
  text += place_line("G30", saved_point(parameters, second_home), units);
  text += place_line("G92", modes.frame.g92_offset(), units);
  const double tool = clean(in_units(modes.frame.tool_offset()[Axis::z], Axis::z, units), units.inches ? 4 : 3);
  text += fmt::format("[TLO:{:.{}f}]\r\n", tool, units.inches ? 4 : 3);
  return text + probe_text(probe, units);
}

// V: a spindle of any speed. Then the planner's blocks and the bytes of the receive buffer.
std::string build_text(std::string_view words) {
  return fmt::format("[VER:1.1h.20190830:{}]\r\n[OPT:V,{},128]\r\n", words, grbl_planner_blocks);
}

std::string axis_letters(const std::vector<Axis>& axes) {
  std::string letters;
  for (const Axis axis : axes) letters += letter_of(axis);
  return letters;
}

// ENUMS: $ES, $EG, $EA and $EE are answered. RT+: real-time commands as in Grbl.
std::string more_build_text(std::string_view axes) {
  return fmt::format("[AXS:{}:{}]\r\n[NEWOPT:ENUMS,RT+]\r\n[FIRMWARE:Passo]\r\n", axes.size(), axes);
}

std::string help_text() {
  return "[HLP:$$ $# $G $I $N $x=val $Nx=line $J=line $SLP $C $X $H ~ ! ? ctrl-x]\r\n";
}

}  // namespace passo
