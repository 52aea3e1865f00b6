// The page of `passo check`: what a program was judged to be, as text and JSON.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "passo/judge/judgement.hpp"

namespace passo {

// 0:12:31
std::string clock_words(Seconds time);
const AxisDescription& description_of(const MachineDescription& machine, Axis axis);
// "the acceleration of Z, 500 mm/s²".
std::string limit_words(const SpeedShare& share);
// How far the feeds go in a work system, along its axes: "X 0.000 to 40.000 mm, Y …". Empty: it has no feed.
std::string feed_words(const WorkSummary& work, const RunSummary& summary);

std::string to_text(const Judgement& page, const MachineDescription& machine);
// Adds the keys `time_s`, `dwell_s`, `tool_changes`, `line`, `axes`, `work`, `speed` and `margin`.
void add_to(nlohmann::ordered_json& json, const Judgement& page, const MachineDescription& machine);

}  // namespace passo
