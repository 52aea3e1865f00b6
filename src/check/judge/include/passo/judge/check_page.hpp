// The output of `passo check`: the analysis of a program, as text and JSON.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/judge/judgement.hpp"
#include "passo/judge/program_stops.hpp"

namespace passo {

// Formats a duration: 0:12:31
std::string clock_words(Seconds time);
const AxisDescription& description_of(const MachineDescription& machine, Axis axis);
// Returns e.g. "the acceleration of Z, 500 mm/s²".
std::string limit_words(const SpeedShare& share);
// Returns the range of the feed moves in a work coordinate system, along its axes: "X 0.000 to 40.000 mm, Y …". Empty:
// there is no feed move.
std::string feed_words(const WorkSummary& work, const RunSummary& summary);

// The findings, and where the program stops for the operator: the keys `good`, `errors`, `findings`, `waits` and
// `waits_first_at`.
nlohmann::ordered_json findings_as_json(const Diagnostics& findings, const ProgramStops& stops);
// What limits the speed, and for how much of the time of the motion; and the slowest and the fastest lines.
std::string speed_words(const SpeedReport& speed, Seconds whole);
nlohmann::ordered_json as_json(const SpeedReport& speed);
std::string to_text(const Judgement& page, const MachineDescription& machine);
// Adds the keys `time_s`, `dwell_s`, `tool_changes`, `line`, `axes`, `work`, `speed` and `margin`.
void add_to(nlohmann::ordered_json& json, const Judgement& page, const MachineDescription& machine);

}  // namespace passo
