// A program, a homing or a jog on a separate drive, without a machine session. For tests of all stages from the text to
// the board. The session's own functions are tested in session/ and by the soak test.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "passo/activity/homing_path.hpp"
#include "passo/activity/jog_line.hpp"
#include "passo/activity/machine_plant.hpp"
#include "passo/activity/program.hpp"
#include "passo/activity/stage_options.hpp"
#include "passo/drive/motion_drive.hpp"
#include "passo/interpreter/tool_change_plan.hpp"
#include "passo/journal/resume_point.hpp"
#include "passo/link/await.hpp"
#include "passo/machine/virtual_line.hpp"
#include "passo/machine/virtual_machine.hpp"

namespace passo::test {

// On a virtual link, a working board responds immediately. On a real link, a board may still be in its boot loader.
inline constexpr LinkTimeouts virtual_line_care{.answer_within = Seconds(0.05)};
inline constexpr LinkTimeouts real_line_care{.answer_within = Seconds(0.1), .patience = Seconds(60)};

inline StepOptions steps_from(const MachineDescription& machine, const Point& start) {
  StepOptions options = step_options(machine);
  options.start = start;
  return options;
}

// Advances the time while the drive waits: in a hold, or while outputs are switched on. Returns early if the drive
// ends.
inline void let_pass(MotionDrive& drive, Seconds time) {
  for (const Seconds end = drive.now() + time; end - drive.now() > hardly_any && drive.poll(end - drive.now());) {
  }
}

struct DriveOn {
  std::optional<LineOptions> line = {};  // a link to the virtual machine; empty: no link
  BoardPort* board = nullptr;            // drives this board; the virtual machine then mirrors the board
  std::uint16_t session = 1;
  std::uint8_t greeting = 0;
  std::optional<ResumePoint> resume_at = {};
  std::optional<Point> stands = {};             // the machine position at that time; empty: at that point
  std::vector<ProbeOutcome> known_probes = {};  // results of the probe moves before that point
  Plant* plant = nullptr;  // behind the virtual machine if that is the board; null: the plant of the machine file
  bool answers_probes = true;
  bool waits_for_operator = false;
  Commitment live = endless_commitment;
};

// The board of a drive, after the handshake.
class DrivenBoard {
 public:
  DrivenBoard(const MachineDescription& machine, const Point& start, const DriveOn& on)
      : machine_(static_cast<std::uint8_t>(machine.axes.size()), machine.board.clock, machine.board.highest_event_rate,
                 static_cast<std::size_t>(machine.board.held_items)),
        plant_(plant_of(machine, start)) {
    if (on.line) line_.emplace(machine_, machine.board.clock, *on.line);
    if (on.board == nullptr) machine_.connect(on.plant != nullptr ? *on.plant : plant_);
    machine_.stand_at(steps_at(machine, start));
    remote_ = line_ || on.board != nullptr;
    if (on.board != nullptr) {
      session_ = std::make_unique<BoardSession>(*on.board, real_line_care);
    } else if (line_) {
      session_ = std::make_unique<BoardSession>(*line_, virtual_line_care);
    } else {
      session_ = std::make_unique<BoardSession>(machine_);
    }
    greet(*session_, {.motors = static_cast<std::uint8_t>(machine.axes.size()),
                      .session = remote_ ? on.session : std::uint16_t{0},
                      .number = on.greeting});
    if (on.board == nullptr) return;
    shadow_ = std::make_unique<BoardSession>(machine_);
    greet(*shadow_, {.motors = static_cast<std::uint8_t>(machine.axes.size())});
  }

  VirtualMachine& machine() { return machine_; }
  VirtualLine& line() { return *line_; }
  BoardSession& session() { return *session_; }
  const BoardSession& session() const { return *session_; }
  bool is_remote() const { return remote_; }
  // Makes the virtual machine mirror the real board.
  void follow(MotionDrive& drive) {
    if (!shadow_ || drive.ledger() == nullptr) return;
    drive.ledger()->watch_executed([this](const LinkItem& item) { send(*shadow_, item); });
  }
  void catch_up() {
    if (shadow_) drain(*shadow_);
  }

 private:
  VirtualMachine machine_;
  IdealPlant plant_;
  std::optional<VirtualLine> line_;
  bool remote_ = false;
  std::unique_ptr<BoardSession> session_;
  std::unique_ptr<BoardSession> shadow_;
};

class DrivenProgram {
 public:
  DrivenProgram(ProgramReader reader, const MachineDescription& machine, const InterpreterOptions& options,
                Diagnostics& diagnostics, const DriveOn& on = {})
      : on_(on),
        start_(on.resume_at ? on.stands.value_or(on.resume_at->point) : options.start),
        board_(machine, start_, on),
        // A tap cannot reverse with the spindle over a link, or with jerk limits.
        answers_({.probes = on.answers_probes,
                  .taps = !board_.is_remote() && machine.spindle.counts_per_turn > 0 && !has_jerk_limit(machine)}),
        program_(std::move(reader), machine, options, answers_, diagnostics, Seconds(0), on.known_probes),
        steps_(steps_from(machine, start_)),
        unsuited_(
            passo::unsuited(board_.session(), steps_, on.board != nullptr && machine.spindle.counts_per_turn > 0)),
        drive_(program_, motion_limits(machine), steps_, board_.session(), answers_, drive_options(machine)) {
    board_.follow(drive_);
  }

  // Advances the drive a little. Returns false at the end of the program.
  [[nodiscard]] bool advance() {
    const bool goes_on = drive_.poll();
    if (!goes_on || drive_.state() == MotionDrive::State::held) board_.catch_up();
    return goes_on;
  }
  // Switches on the outputs that are on at the resume point of the job.
  void resume() {
    if (on_.resume_at && drive_.ledger() != nullptr) {
      drive_.switch_on(on_.resume_at->outputs, on_.resume_at->spindle_wait);
    }
  }
  const std::optional<std::string>& unsuited() const { return unsuited_; }
  // Returns the reentry move to the resume point of the job.
  std::vector<PathItem> lead_in() const {
    return on_.resume_at ? way_back_of_probe(*on_.resume_at, start_) : std::vector<PathItem>();
  }

  MotionDrive& drive() { return drive_; }
  Program& program() { return program_; }
  Tap<PathItem>& path() { return program_.path(); }
  Tap<MotionItem>& motion() { return drive_.motion(); }
  Tap<BoardItem>& items() { return drive_.items(); }
  VirtualMachine& machine() { return board_.machine(); }
  VirtualLine& line() { return board_.line(); }
  BoardSession& session() { return board_.session(); }
  const BoardSession& link() const { return board_.session(); }

 private:
  DriveOptions drive_options(const MachineDescription& machine) const {
    DriveOptions options{.live = on_.live,
                         .spindle_run_up = machine.spindle.run_up,
                         .counts_per_turn = machine.spindle.counts_per_turn,
                         .guards_by_probe = machine.probe.guards && on_.answers_probes,
                         .waits_for_operator = on_.waits_for_operator,
                         .kept_in_stops = kept_in_stops(machine)};
    if (machine.tool_change) options.coolant_wait = collet_wait(*machine.tool_change);
    if (options.guards_by_probe) options.live = live_commitment;
    if (board_.is_remote() && !board_.session().error() && !unsuited_) options.tails.emplace();
    if (on_.resume_at) {
      options.begin_at = on_.resume_at->place;
      options.switches = static_cast<std::uint8_t>(on_.resume_at->switches & options.kept_in_stops);
    }
    options.lead_in = lead_in();
    return options;
  }

  DriveOn on_;
  Point start_;
  DrivenBoard board_;
  StoredResults answers_;
  Program program_;
  StepOptions steps_;
  std::optional<std::string> unsuited_;
  MotionDrive drive_;
};

class DrivenHoming {
 public:
  DrivenHoming(const MachineDescription& machine, const DriveOn& on = {})
      : board_(machine, Point(), on),
        path_(machine, answers_),
        steps_(step_options(machine)),
        unsuited_(passo::unsuited(board_.session(), steps_, false)),
        drive_(path_, motion_limits(machine), steps_, board_.session(), answers_, drive_options()) {}

  [[nodiscard]] bool advance() { return drive_.poll(); }
  const std::optional<std::string>& unsuited() const { return unsuited_; }
  const HomingPath& path() const { return path_; }
  bool done() const { return path_.done() && !drive_.link().error(); }
  Point place() const { return path_.place(); }
  MotionDrive& drive() { return drive_; }
  const MotionDrive& drive() const { return drive_; }
  VirtualMachine& machine() { return board_.machine(); }
  VirtualLine& line() { return board_.line(); }
  BoardSession& session() { return board_.session(); }

 private:
  DriveOptions drive_options() const {
    DriveOptions options;
    if (board_.is_remote() && !board_.session().error() && !unsuited_) options.tails.emplace();
    return options;
  }

  StoredResults answers_;
  DrivenBoard board_;
  HomingPath path_;
  StepOptions steps_;
  std::optional<std::string> unsuited_;
  MotionDrive drive_;
};

// A jog without a keep-alive timeout. It continues until its end, or until it is stopped.
class DrivenJog {
 public:
  DrivenJog(const MachineDescription& machine, const Point& start, const JogWay& way, const DriveOn& on = {})
      : board_(machine, start, on),
        path_(machine, start, way),
        drive_(path_, motion_limits(machine), steps_from(machine, start), board_.session(), answers_,
               {.live = live_commitment}),
        place_(start) {
    drive_.motion().watch([this](const MotionItem& item) {
      if (const auto* move = std::get_if<PlannedMove>(&item)) place_ = move->segment.curve.at(move->to);
    });
  }

  [[nodiscard]] bool advance() { return drive_.poll(); }
  const Point& target() const { return path_.target(); }
  // Returns the end of the committed motion.
  const Point& place() const { return place_; }
  MotionDrive& drive() { return drive_; }
  VirtualMachine& machine() { return board_.machine(); }

 private:
  StoredResults answers_;
  DrivenBoard board_;
  JogLine path_;
  MotionDrive drive_;
  Point place_;
};

}  // namespace passo::test
