// Program: the first half of the pipeline, from text to a smooth path, as an activity.
//
// A program is interpreted twice: once to check it, once to run it. The check also builds the path. So every error is
// reported before any motion, and the remaining time is known.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "passo/activity/activity.hpp"
#include "passo/activity/frequent_mistakes.hpp"
#include "passo/activity/low_rapids.hpp"
#include "passo/activity/operator_messages.hpp"
#include "passo/activity/program_stages.hpp"
#include "passo/activity/spindle_mistakes.hpp"
#include "passo/activity/tool_track.hpp"
#include "passo/base/tap.hpp"
#include "passo/diagnostics/diagnostic.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/interpreter/interpreter.hpp"
#include "passo/interpreter/machine_results.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/path/path_builder.hpp"
#include "passo/trajectory/planner.hpp"

namespace passo {

// The result of a check, known before the program is planned.
struct ProgramCheck {
  bool good = false;        // no error: the program may run
  Seconds nominal_time{0};  // at the programmed speeds, without ramps; only to show progress
  std::uint64_t moves = 0;
  bool tools_change = false;  // the program changes the tool table
  bool probes = false;        // the check assumed that probe moves make contact at their ends
};

// Interprets a program and builds its path, in bounded pieces. Errors and warnings go to `diagnostics`.
//
// The check cannot know the results of probe moves, and assumes contact at their ends. So the path of the run may
// differ, and path errors after the first probe move are reported as warnings. Syntax errors remain errors. A loop that
// only a probe result can end is cut off.
//
// The observers, and the time, know M6 as a stop. On a machine whose M6 moves ([tool_change]), a program without errors
// is then checked once more with these moves, for errors alone. So are the hooks of the machine file.
class ProgramChecker {
 public:
  // `diagnostics` must outlive the checker.
  ProgramChecker(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                 Diagnostics& diagnostics);
  ~ProgramChecker();
  // Adds an observer of each path item.
  void watch(std::function<void(const PathItem&)> watcher) { watcher_ = std::move(watcher); }
  // Adds an observer of each operation of the program.
  void watch_operations(Tap<Operation>::Watcher watcher) { operations_.watch(std::move(watcher)); }
  // Checks up to `items` more path items. Returns true if the check has ended, and result() is complete.
  [[nodiscard]] bool go_on(std::uint64_t items);
  const ProgramCheck& result() const { return check_; }
  // The coordinate system of the item passed to the observer.
  const Frame& frame() const { return builder_.frame(); }

 private:
  struct Changes;

  bool pull_item();
  bool begins_changes();
  bool pull_change();
  void finish();

  Diagnostics& diagnostics_;
  PathOptions path_options_;
  MotionLimits limits_;
  ToolTable tools_;                     // the tool table before the check
  std::optional<ProgramReader> again_;  // on a machine whose M6 moves
  InterpreterOptions changing_;         // then: with that M6
  Interpreter interpreter_;
  ToolTrack track_;
  FrequentMistakes mistakes_;
  LowRapids low_rapids_;
  SpindleMistakes spindle_mistakes_;
  Tap<Operation> operations_;
  PathBuilder builder_;
  std::function<void(const PathItem&)> watcher_;
  ProgramCheck check_;
  PathItem item_;
  std::unique_ptr<Changes> changes_;
  bool changes_tools_ = false;
  std::uint64_t after_a_probe_ = 0;
  bool done_ = false;
};

// Checks the whole program at once. `watch` is called with each path item, `watch_operations` with each operation.
ProgramCheck check_program(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                           Diagnostics& diagnostics, const std::function<void(const PathItem&)>& watch = {},
                           const Tap<Operation>::Watcher& watch_operations = {});

class Program final : public Activity {
 public:
  // `answers` and `diagnostics` must outlive the program. `diagnostics` receives findings of the run: none after a
  // successful check, unless the program probes. An error during the run ends the path, with a stop before the wrong
  // move. `whole`: the nominal time from the check, for progress(). `known_probes`: the earlier results of the first
  // probe moves, for a program that continues after them.
  Program(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
          const MachineResults& answers, Diagnostics& diagnostics, Seconds whole = Seconds(0),
          std::vector<ProbeOutcome> known_probes = {});

  ActivityKind kind() const override { return ActivityKind::program; }
  [[nodiscard]] bool next(PathItem& item) override { return stages_.smooth_path().next(item); }
  std::optional<double> progress() const override;

  // Taps for observers of the operations and of the programmed path. Add observers before the first next().
  Tap<Operation>& operations() { return stages_.operations(); }
  Tap<PathItem>& path() { return stages_.path(); }
  const Frame& frame() const { return stages_.path_builder().frame(); }
  SavedParameters saved_parameters() const { return stages_.interpreter().saved_parameters(); }
  const ToolTable& tools() const { return stages_.interpreter().tools(); }
  std::optional<ToolMeasurement> measured_tool() const { return stages_.interpreter().measured_tool(); }
  OperatorMessages& operator_messages() { return operator_messages_; }
  // The nominal time of the path planned so far.
  Seconds nominal_time() const { return nominal_time_; }

 private:
  MotionLimits limits_;
  ProgramStages stages_;
  OperatorMessages operator_messages_;
  Seconds whole_;
  Seconds nominal_time_{0};
};

}  // namespace passo
