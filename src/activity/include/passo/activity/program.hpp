// Program: the upper half of the street, from text to a smooth path, as an activity.
//
// A program is gone through twice. The check interprets it and builds the path, so that everything that is wrong with
// it is said before anything turns, and so that the time that is left can be told. The second time it is run.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "passo/activity/activity.hpp"
#include "passo/activity/good_path.hpp"
#include "passo/base/tap.hpp"
#include "passo/diagnostics/diagnostic.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/interpreter/interpreter.hpp"
#include "passo/interpreter/machine_answers.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/path/path_builder.hpp"
#include "passo/path/path_smoother.hpp"
#include "passo/trajectory/planner.hpp"

namespace passo {

// What a program amounts to before it is planned.
struct ProgramCheck {
  bool good = false;        // no error: it may run
  Seconds nominal_time{0};  // at the programmed speeds, without ramps: good for progress only
  std::uint64_t moves = 0;
  bool tools_change = false;  // the program sets some in the tool table
  bool probes = false;        // and what comes after was checked as if probe moves were touched at their ends
};

// Interprets a program and builds its path, a bounded piece at a time; what is wrong is in `diagnostics`.
//
// What a probe will find is not known yet. Probe moves are taken to be touched at their ends; so the path may be
// another in the run, and after the first probe move what is wrong with it is told as a warning. Errors in how the
// program is written remain errors. A loop that only a probe can end is not followed for ever.
class ProgramChecker {
 public:
  // `diagnostics` outlives the checker.
  ProgramChecker(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                 Diagnostics& diagnostics);
  // Who wants to see the path.
  void watch(std::function<void(const PathItem&)> watcher) { watcher_ = std::move(watcher); }
  // Goes on by so many path items. True at the end: result() is whole.
  [[nodiscard]] bool go_on(std::uint64_t items);
  const ProgramCheck& result() const { return check_; }

 private:
  bool take_item();
  void finish();

  Diagnostics& diagnostics_;
  PathOptions path_options_;
  MotionLimits limits_;
  ToolTable tools_;  // as they were before
  Interpreter interpreter_;
  PathBuilder builder_;
  std::function<void(const PathItem&)> watcher_;
  ProgramCheck check_;
  PathItem item_;
  std::uint64_t after_a_probe_ = 0;
  bool done_ = false;
};

// All at once. `watch` gets the path.
ProgramCheck check_program(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                           Diagnostics& diagnostics, const std::function<void(const PathItem&)>& watch = {});

class Program final : public Activity {
 public:
  // `answers` and `diagnostics` outlive the program. `diagnostics` gets what is still found amid the run: nothing after
  // a good check, if nothing was probed. An error there ends the path, at rest before the move that is wrong. `whole`:
  // the nominal time of the check, for progress().
  Program(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
          const MachineAnswers& answers, Diagnostics& diagnostics, Seconds whole = Seconds(0));

  ActivityKind kind() const override { return ActivityKind::program; }
  [[nodiscard]] bool next(PathItem& item) override { return smoother_.next(item); }
  std::optional<double> progress() const override;

  // Who wants to watch the path as the program means it, before the first next().
  Tap<PathItem>& path() { return watched_path_; }
  const Frame& frame() const { return path_builder_.frame(); }
  SavedParameters saved_parameters() const { return interpreter_.saved_parameters(); }
  const ToolTable& tools() const { return interpreter_.tools(); }
  // Of what has been planned so far.
  Seconds nominal_time() const { return nominal_time_; }

 private:
  PathOptions path_options_;
  MotionLimits limits_;
  Interpreter interpreter_;   // text -> blocks -> operations
  PathBuilder path_builder_;  // operations -> segments
  GoodPath good_path_;        // as long as nothing is wrong
  Tap<PathItem> watched_path_;
  PathSmoother smoother_;  // corners -> curves within the tolerance
  Seconds whole_;
  Seconds nominal_time_{0};
};

}  // namespace passo
