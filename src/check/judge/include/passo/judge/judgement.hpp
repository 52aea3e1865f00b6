// judge(): analyses an error-free program before a run: its duration, its range, what limits its speed, and whether the
// motors have enough torque.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "passo/activity/program.hpp"
#include "passo/cutting/cut_loads.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/judge/link_delay.hpp"
#include "passo/report/path_recorder.hpp"
#include "passo/report/summary.hpp"
#include "passo/session/planned_program.hpp"
#include "passo/verdict/load_track.hpp"
#include "passo/verdict/margin_survey.hpp"
#include "passo/verdict/speed_survey.hpp"

namespace passo {

struct Judgement {
  RunSummary summary;
  SpeedReport speed;
  MarginVerdict margin;
  std::uint64_t tool_changes = 0;
  bool knows_motors = false;           // the machine file describes the motors; otherwise their torque is not analysed
  std::optional<LinkDelay> line = {};  // result of link_delay(), if the caller requested it

  // Returns whether the motors are certain to lose steps.
  bool lost() const { return margin.verdict == Verdict::lost; }
};

// The greatest load of each program line that moves. Memory: 4 bytes per line.
class LineTorques {
 public:
  void add(std::uint32_t line, double load);
  // Returns a CSV: a header, and a row `line,load` for each line that moves; 1 is the whole guaranteed torque.
  std::string text() const;

 private:
  std::vector<float> loads_;  // load of each line; negative: the line does not move
};

// Optional receivers of the motion and its load. Null: none.
struct JudgeWatchers {
  PathRecorder* path = nullptr;
  LoadTrack* track = nullptr;
  CutLoads* loads = nullptr;  // cutting loads of the same program
  LineTorques* lines = nullptr;
};

// Plans a checked program with these overrides and analyses its motion. `progress`, if set, is called from time to time
// with the completed fraction. Cannot fail.
Judgement judge(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                const ProgramCheck& check, const JudgeWatchers& watchers = {},
                const std::function<void(double)>& progress = {}, const MotionFactors& factors = {});
// Analyses a motion from another source. `whole`: the nominal time of the program.
Judgement judge(ProgramMotion& motion, const MachineDescription& machine, Seconds whole,
                const JudgeWatchers& watchers = {}, const std::function<void(double)>& progress = {});

}  // namespace passo
