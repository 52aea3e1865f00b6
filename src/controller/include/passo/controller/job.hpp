// Job: the composition root. Owns the stages of the street, in order, and pulls the last one.
//
// A job runs twice over its program. The checking pass interprets it and builds the path, so that everything that is
// wrong with it is said before anything turns, and so that the time that is left can be told. The second pass runs it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "passo/base/source.hpp"
#include "passo/controller/good_path.hpp"
#include "passo/controller/motion_drive.hpp"
#include "passo/controller/resume_point.hpp"
#include "passo/controller/tap.hpp"
#include "passo/diagnostics/diagnostic.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/interpreter/interpreter.hpp"
#include "passo/machine/virtual_line.hpp"
#include "passo/machine/virtual_machine.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/path/path_builder.hpp"
#include "passo/path/path_smoother.hpp"

namespace passo {

// What a program amounts to before it is planned.
struct ProgramCheck {
  bool good = false;        // no error: it may run
  Seconds nominal_time{0};  // at the programmed speeds, without ramps: good for progress only
  std::uint64_t moves = 0;
  bool tools_change = false;  // the program sets some in the tool table
  bool probes = false;        // and what comes behind was checked as if probe moves were touched at their ends
};

// Interprets the whole program and builds its path; what is wrong is in `diagnostics`.
//
// What a probe will find is not known yet. Probe moves are taken to be touched at their ends; so the path may be
// another in the run, and behind the first probe move what is wrong with it is told as a warning. Errors in how the
// program is written remain errors. A loop that only a probe can end is not followed for ever. `watch` gets the path.
ProgramCheck check_program(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                           Diagnostics& diagnostics, const std::function<void(const PathItem&)>& watch = {});

class Job {
 public:
  // Who tells what probe moves find: the board; or nobody, and they are touched at their ends, as in the checking pass.
  enum class Probing : std::uint8_t { by_board, nominal };

  struct Options {
    Probing probing = Probing::by_board;
    // With a line the board is at its other end, and what it holds always ends at rest.
    std::optional<LineOptions> line = {};
    // What hangs on the virtual machine; none: the plant that the machine's description tells of, standing where the
    // job starts. Outlives the job.
    Plant* plant = nullptr;
    // A real one, in the place of the virtual machine, which then only does what the board tells to have done: for
    // counts, traces and pictures. What the board holds always ends at rest. Outlives the job.
    BoardPort* board = nullptr;
    // By which that board knows it again, and from where its items are counted: LineCare's.
    std::uint16_t session = 1;
    std::uint8_t greeting = 0;
    // The job was begun by another host, and the board rests there. resume() before the first advance().
    std::optional<ResumePoint> resume_at = {};
  };

  // `diagnostics` gets what the second pass still finds: nothing after a good check, if nothing was probed. An error
  // there ends the job, at rest before the move that is wrong.
  Job(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& interpretation,
      Diagnostics& diagnostics, const Options& options);
  Job(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& interpretation,
      Diagnostics& diagnostics)
      : Job(std::move(program), machine, interpretation, diagnostics, Options()) {}

  // Plays a little more of the job (one board segment). False at the end, with everything at rest, and when the link
  // has an error.
  [[nodiscard]] bool advance();
  // Switches on what is on there.
  void resume();
  // What keeps the job from being run on the board that it found, as a sentence without a full stop.
  std::optional<std::string> unsuited() const;

  // To hold, resume, change and stop it in mid-run.
  MotionDrive& drive() { return drive_; }
  const MotionDrive& drive() const { return drive_; }

  // Who wants to watch, before the first advance().
  Tap<PathItem>& path() { return watched_path_; }
  Tap<MotionItem>& motion() { return drive_.motion(); }
  Tap<BoardItem>& board() { return drive_.board(); }
  VirtualMachine& machine() { return machine_; }
  // To spoil what goes over it; only of a job that has one.
  VirtualLine& line() { return *line_; }
  const BoardLink& link() const { return drive_.link(); }
  const Frame& frame() const { return path_builder_.frame(); }
  SavedParameters saved_parameters() const { return interpreter_.saved_parameters(); }
  const ToolTable& tools() const { return interpreter_.tools(); }

  // The nominal time of what has been planned so far.
  Seconds nominal_time() const { return nominal_time_; }

 private:
  static BoardLine board_line(const Options& options, std::optional<VirtualLine>& line);
  void connect_plant(const MachineDescription& machine, Plant* plant);
  void follow_by_machine(std::uint8_t motors);

  PathOptions path_options_;
  MotionLimits limits_;
  ProbeOutcome probe_outcome_;
  Point tap_rest_;

  // The street.
  Interpreter interpreter_;   // text -> blocks -> operations
  PathBuilder path_builder_;  // operations -> segments
  GoodPath good_path_;        // as long as nothing is wrong
  Tap<PathItem> watched_path_;
  PathSmoother smoother_;  // corners -> curves within the tolerance
  IdealPlant own_plant_;
  VirtualMachine machine_;  // what is at the other end of the wire
  std::optional<VirtualLine> line_;
  MotionDrive drive_;  // segments -> phases -> board segments -> wire
  std::optional<ResumePoint> resume_at_;
  bool wants_encoder_;               // of the board that is found
  std::optional<BoardLink> shadow_;  // to the machine, where it is not the board

  Seconds nominal_time_{0};
};

}  // namespace passo
