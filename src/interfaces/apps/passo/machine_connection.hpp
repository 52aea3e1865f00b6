// MachineConnection: a machine session on the board given on the command line, with the plant behind a virtual or
// emulated board, and a virtual machine that mirrors a real board, for counts and traces.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "board_claim.hpp"
#include "scheduled_changes.hpp"
#include "spindle_opening.hpp"

#include "passo/activity/touchable.hpp"
#include "passo/job/job_end.hpp"
#include "passo/job/stored_position.hpp"
#include "passo/machine/virtual_line.hpp"
#include "passo/machine/virtual_machine.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/plant/fitted_plant.hpp"
#include "passo/plant/rotor_plant.hpp"
#include "passo/session/board_machine_session.hpp"

namespace passo {

struct MachineWish {
  std::string board = "virtual";               // a board address, in the format of parse_board_address()
  bool over_a_line = false;                    // the virtual machine is at the end of a virtual serial link
  std::optional<CableCut> cut = {};            // the link is cut; only with over_a_line
  std::vector<Touchable> touchables = {};      // objects that the probe of a virtual or emulated board can touch
  bool physics = false;                        // simulates the physics of the motors of a virtual or emulated machine
  std::vector<Disturbance> disturbances = {};  // disturbances of motors; only with physics
  bool plant_apart = false;                    // something else than the virtual machine drives the plant: PortRun
  bool tells_place = false;                    // see SessionOptions
  bool needs_place = false;                    // see SessionOptions
  SpindleWish spindle = SpindleWish::none;     // for [spindle.modbus]; only with a real board
  bool may_move = false;                       // another host may have left the board in motion
};

class MachineConnection {
 public:
  // Opens a board. Null, with a message and the exit code in `code`, if there is no such board, if another program
  // drives it, or if the board is moving and must not. A board on a serial link has been asked for its status, but the
  // handshake has not been done.
  static std::unique_ptr<MachineConnection> open(const MachineDescription& machine, const MachineWish& wish, int& code);
  // Saves the machine position: keep_place().
  ~MachineConnection();
  MachineConnection(const MachineConnection&) = delete;
  MachineConnection& operator=(const MachineConnection&) = delete;

  BoardMachineSession& session() { return *session_; }
  const BoardMachineSession& session() const { return *session_; }
  // Returns the board itself, or the virtual machine that mirrors the board.
  VirtualMachine& machine() { return machine_; }
  // Returns the motors with physics, or null without physics: then they follow their steps exactly.
  RotorPlant* rotors() { return rotors_; }
  // Returns the plant behind a virtual or emulated board.
  FittedPlant& plant() { return *plant_; }
  // Returns true if the board is in another process or is emulated.
  bool has_board() const { return port_ != nullptr; }
  // Returns the board's status before the handshake.
  const BoardStatus& before() const { return before_; }
  // Returns true if the board is independent of this program, at the end of a serial link that may fail.
  bool is_on_a_line() const { return claim_.has_value(); }
  // Queries the board until it is stopped. Otherwise returns the reason, as a sentence. Must be called before the
  // handshake.
  std::optional<std::string> wait_for_rest();
  // Returns the machine position before the handshake, or why it is unknown. Virtual and emulated machines are at
  // machine zero. The position of a real board is known from what an earlier command has saved, and from the board's
  // counts.
  Result<KnownPosition, PositionDoubt> place() const;
  // Sets the machine to that position. If the position is unknown, but the board has kept counting, sets the position
  // of the previous command. Must be called before the handshake.
  void stand_as_counted();
  // Sets the machine position, before the handshake.
  void start_at(const KnownPosition& position) { session_->start_at(position); }
  // Sets the actual position of a virtual machine, independent of the position that its board assumes. Must be called
  // before the board drives it.
  void stand_in_truth_at(const Point& place);
  // Performs the handshake with the board, and waits until the machine is ready. Returns false, with a message, if the
  // board is not suitable.
  [[nodiscard]] bool greet(const Greeting& greeting, int& code);
  // Returns a handshake request by which the board can be recognised later, if this is useful.
  Greeting any_greeting() const;
  // The traffic to the board since the handshake, without the earlier queries.
  std::uint64_t frames_sent() const { return session_->board().frames_sent() - frames_asked_; }
  std::uint64_t bytes_sent() const { return session_->board().bytes_sent() - bytes_asked_; }
  // Returns a session number that differs from the board's current one.
  std::uint16_t new_session_number() const;
  // Begins to give the board another session number, after the handshake and at standstill. board().ready() becomes
  // true when this is done.
  void begin_session(std::uint16_t number);
  // Does the same, and waits. Returns false, with a message, if the board does not respond.
  [[nodiscard]] bool name_session(std::uint16_t number, int& code);
  // Saves the current position for the next command.
  void keep_place();

  // Sends everything that the board has executed to the virtual machine, too. The virtual machine's motors are at this
  // position when the program begins.
  void follow(Watchers& watchers, const Point& place);
  void catch_up();
  // Compares at the end whether the motor positions agree with the counts, if they are known. Returns the difference.
  std::optional<std::string> compare();

 private:
  MachineConnection(const MachineDescription& machine, const MachineWish& wish);
  bool ask_first(const std::string& address, bool may_move, int& code);
  void write_down(const KnownPosition& position, const MotorSteps& zero_counts, const SessionNumbers& numbers);

  const MachineDescription& description_;
  std::unique_ptr<FittedPlant> plant_;
  RotorPlant* rotors_ = nullptr;  // plant_, if it simulates physics
  VirtualMachine machine_;
  std::optional<VirtualLine> line_;
  std::unique_ptr<BoardPort> port_;
  std::unique_ptr<ModbusSpindle> spindle_;
  bool plant_is_behind_ = true;
  std::unique_ptr<BoardMachineSession> session_;
  std::unique_ptr<BoardSession> shadow_;
  BoardStatus before_;
  std::optional<BoardClaim> claim_;
  std::optional<StoredPosition> stored_position_;  // for a board that is independent of this program
  SessionNumbers numbers_;
  bool greeted_ = false;
  std::uint64_t frames_asked_ = 0;
  std::uint64_t bytes_asked_ = 0;
};

// Formats a position, with the axis letters: "X1.000 Y-2.500".
std::string place_words(const MachineDescription& machine, const Point& place);
// Returns e.g. "the machine is busy [machine.busy]".
std::string describe(const Refusal& refusal);
// Makes a request and ignores a refusal, which means that the machine is already in the requested state.
void try_request(MachineSession& session, Request wanted);
// Polls the session until nothing is active. Ctrl-C brakes. `look`, if set, is called after each turn.
void poll_until_end(MachineConnection& machine, const std::function<void()>& look = {});

}  // namespace passo
