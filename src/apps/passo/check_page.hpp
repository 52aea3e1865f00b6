// CheckPage: what `passo check` says of a program without errors: how long it takes, how far it goes, and whether the
// motors can do it. The program is planned, but no step is made.
#pragma once

#include <string>

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

  // Whether the motors would surely lose steps.
  bool lost() const { return margin.verdict == Verdict::lost; }
};

// Plans a program that was checked, and judges its motion. `path` gets the motion with its load; null: nobody draws.
CheckPage judge(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                const ProgramCheck& check, PathRecorder* path = nullptr);

std::string to_text(const CheckPage& page, const MachineDescription& machine);
// Adds the keys `time_s`, `dwell_s`, `tool_changes`, `axes` and `margin`.
void add_to(nlohmann::ordered_json& json, const CheckPage& page, const MachineDescription& machine);

}  // namespace passo
