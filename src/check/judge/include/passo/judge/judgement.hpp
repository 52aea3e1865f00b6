// judge(): what there is to say of a program without errors, before it is run: how long it takes, how far it goes, what
// bounds its speed, and whether the motors can do it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "passo/activity/program.hpp"
#include "passo/cutting/cut_loads.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/judge/line_cost.hpp"
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
  bool knows_motors = false;          // the machine file describes them; otherwise their torque is not judged
  std::optional<LineCost> line = {};  // of line_cost(), from whoever asks for it

  // Whether the motors would surely lose steps.
  bool lost() const { return margin.verdict == Verdict::lost; }
};

// The greatest load of each line of a program that moves. Memory: 4 bytes a line.
class LineLoads {
 public:
  void add(std::uint32_t line, double load);
  // CSV: a head, and a line `line,load` for each line that moves; 1: all of the torque that is surely there.
  std::string text() const;

 private:
  std::vector<float> loads_;  // below 0: the line does not move
};

// What else gets the motion, with its load. Null: nobody wants it.
struct JudgeWatchers {
  PathRecorder* path = nullptr;
  LoadTrack* track = nullptr;
  CutLoads* loads = nullptr;  // of the same program's cut
  LineLoads* lines = nullptr;
};

// Plans a program that was checked, at these overrides, and judges its motion. `progress`, if any, is told now and then
// which share is done. No error is possible.
Judgement judge(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                const ProgramCheck& check, const JudgeWatchers& watchers = {},
                const std::function<void(double)>& progress = {}, const MotionFactors& factors = {});

}  // namespace passo
