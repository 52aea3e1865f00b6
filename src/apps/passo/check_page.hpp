// CheckPage: what `passo check` says of a program without errors: how long it takes, how far it goes, what a line to
// the board costs, and whether the motors can do it.
#pragma once

#include <optional>
#include <string>

#include "line_cost.hpp"
#include <nlohmann/json_fwd.hpp>

#include "passo/activity/program.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/report/path_recorder.hpp"
#include "passo/report/summary.hpp"
#include "passo/verdict/margin_survey.hpp"

namespace passo {

struct CheckPage {
  RunSummary summary;
  MarginVerdict margin;
  std::uint64_t tool_changes = 0;
  bool knows_motors = false;
  std::optional<LineCost> line = {};  // empty: the machine file names no places, or a probe decides where to go

  // Whether the motors would surely lose steps.
  bool lost() const { return margin.verdict == Verdict::lost; }
};

// Plans a program that was checked, judges its motion, and plays it over a line. `path` gets the motion with its load;
// null: nobody draws.
CheckPage judge(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                const ProgramCheck& check, PathRecorder* path = nullptr);

std::string to_text(const CheckPage& page, const MachineDescription& machine);
// Adds the keys `time_s`, `dwell_s`, `tool_changes`, `line`, `axes` and `margin`.
void add_to(nlohmann::ordered_json& json, const CheckPage& page, const MachineDescription& machine);

}  // namespace passo
