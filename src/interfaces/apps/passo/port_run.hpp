// PortRun: a run through a parallel port and the PIC of the first control board (`--board sim:first_board`). The steps
// of the virtual machine go through the port into the PIC, and the windings that it switches turn the motors of the
// plant.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "machine_connection.hpp"

#include "passo/confinement/temporary_folder.hpp"
#include "passo/emulator/follower_on_port.hpp"
#include "passo/job/motion_lines.hpp"
#include "passo/kinematics/kinematics.hpp"
#include "passo/machine/machine_observer.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/report/output_file.hpp"
#include "passo/report/summary.hpp"

namespace passo {

// Returns whether the board address means the first control board behind a parallel port.
bool is_on_port(const std::string& board);
// Returns whether the first board can follow the machine's steps: at most three motors, and pulses that are not shorter
// than its loop. If not, shows a message that names `file`, the machine file. `anyway`: the pulses may be too short.
bool suits_the_port(const MachineDescription& machine, const std::string& file, bool anyway);

class PortRun final : public MachineObserver {
 public:
  // Starts the PIC. `machine` and `opened`, whose plant the port drives (MachineWish::plant_apart), must outlive the
  // run. Null, with a message and the exit code in `code`: the emulator did not start.
  static std::unique_ptr<PortRun> start(const MachineDescription& machine, MachineConnection& opened, int& code);
  PortRun(const PortRun&) = delete;
  PortRun& operator=(const PortRun&) = delete;

  void on_steps(Ticks time, std::uint8_t stepped, std::uint8_t directions) override;
  void on_outputs(Ticks time, const BoardOutputs& outputs) override;

  // Writes the rotors' way to a file, as a program of lines in machine coordinates. The file must outlive the run.
  void record_path(OutputFile& file);
  // Adds planned motion, in order. `plan` and `poll` may be called when the program has begun.
  void plan(const MotionItem& item) { lines_.watch(item); }
  // Must be called after each turn of the session. Returns false if the emulator has failed: see error().
  [[nodiscard]] bool poll();
  // Plays what is left, after the program's end.
  void finish();
  // The time up to which the motors have turned.
  Seconds played() const;
  // Why the emulator failed; empty: it did not.
  const std::string& error() const { return board_->error(); }
  // After finish(), and after the rotors have come to rest.
  PortSummary summary();

 private:
  PortRun(const MachineDescription& machine, MachineConnection& opened, std::unique_ptr<TemporaryFolder> folder,
          std::unique_ptr<FollowerOnPort> board);
  Nanoseconds time_of(Ticks time) const;
  void find_lines();
  void write_place(Seconds time);

  const MachineDescription& description_;
  MachineConnection& opened_;
  Kinematics kinematics_;
  std::unique_ptr<TemporaryFolder> folder_;  // outlives the board, which writes there
  std::unique_ptr<FollowerOnPort> board_;
  PlannedLines lines_;
  std::vector<std::uint32_t> lines_of_lost_;
  bool tool_is_on_ = false;
  OutputFile* path_ = nullptr;
  MotorPositions written_{};  // the last place in the path
};

}  // namespace passo
