// CheckPage: what `passo check` says of a program without errors: how long it takes, how far it goes, what bounds its
// speed, what a line to the board costs, and whether the motors can do it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cut_loads.hpp"
#include "line_cost.hpp"
#include <nlohmann/json_fwd.hpp>

#include "passo/activity/program.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/report/path_recorder.hpp"
#include "passo/report/summary.hpp"
#include "passo/session/planned_program.hpp"
#include "passo/verdict/load_track.hpp"
#include "passo/verdict/margin_survey.hpp"
#include "passo/verdict/speed_survey.hpp"

namespace passo {

struct CheckPage {
  RunSummary summary;
  SpeedReport speed;
  MarginVerdict margin;
  std::uint64_t tool_changes = 0;
  bool knows_motors = false;
  std::optional<LineCost> line = {};  // empty: the machine file names no places, or a probe decides where to go

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
struct CheckWatchers {
  PathRecorder* path = nullptr;
  LoadTrack* track = nullptr;
  CutLoads* loads = nullptr;  // of the same program's cut
  LineLoads* lines = nullptr;
};

// Plans a program that was checked, at these overrides, judges its motion, and plays it over a line. `progress` is told
// now and then which share is done.
CheckPage judge(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                const ProgramCheck& check, const CheckWatchers& watchers, const std::function<void(double)>& progress,
                const MotionFactors& factors = {});

// A line of the program that loses less than this against its feed is not told as slow.
inline constexpr Seconds notable_loss{0.005};

// 0:12:31
std::string clock_words(Seconds time);
const AxisDescription& description_of(const MachineDescription& machine, Axis axis);
// "the acceleration of Z, 500 mm/s²".
std::string limit_words(const SpeedShare& share);
// How far the feeds go in a work system, along its axes: "X 0.000 to 40.000 mm, Y …". Empty: it has no feed.
std::string feed_words(const WorkSummary& work, const RunSummary& summary);

std::string to_text(const CheckPage& page, const MachineDescription& machine);
// Adds the keys `time_s`, `dwell_s`, `tool_changes`, `line`, `axes`, `work`, `speed` and `margin`.
void add_to(nlohmann::ordered_json& json, const CheckPage& page, const MachineDescription& machine);

}  // namespace passo
