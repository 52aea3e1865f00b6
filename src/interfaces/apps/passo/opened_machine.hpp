// OpenedMachine: a machine session on the board that the command line names. With it come the plant behind a virtual or
// emulated board, and a virtual machine that repeats what a real board has done, for counts and traces.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "board_claim.hpp"
#include "mid_run_changes.hpp"

#include "passo/activity/touchable.hpp"
#include "passo/job/job_end.hpp"
#include "passo/job/kept_place.hpp"
#include "passo/machine/virtual_line.hpp"
#include "passo/machine/virtual_machine.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/plant/fitted_plant.hpp"
#include "passo/plant/rotor_plant.hpp"
#include "passo/session/machine_session.hpp"

namespace passo {

struct MachineWish {
  std::string board = "virtual";               // as parse_board_address() has it
  bool over_a_line = false;                    // the virtual machine is at the end of a line
  std::optional<CableCut> cut = {};            // the line is cut; only with over_a_line
  std::vector<Touchable> touchables = {};      // what the probe of a virtual or emulated board can touch
  bool physics = false;                        // the motors of a virtual or emulated machine obey physics
  std::vector<Disturbance> disturbances = {};  // only with physics
  bool tells_place = false;                    // see SessionOptions
  bool needs_place = false;                    // the same
  bool may_move = false;                       // another host may have left the board in motion
};

class OpenedMachine {
 public:
  // Opens a board. Null, with a message, if there is no such board, if another program has it, or if the board moves
  // and may not; then `code` is the exit code. A board over a line has been asked for its status, and has not been
  // greeted.
  static std::unique_ptr<OpenedMachine> open(const MachineDescription& machine, const MachineWish& wish, int& code);
  // Writes down where the machine stands: keep_place().
  ~OpenedMachine();
  OpenedMachine(const OpenedMachine&) = delete;
  OpenedMachine& operator=(const OpenedMachine&) = delete;

  MachineSession& session() { return *session_; }
  const MachineSession& session() const { return *session_; }
  // The board itself, or the virtual machine that repeats what the board has done.
  VirtualMachine& machine() { return machine_; }
  // The motors, where they obey physics. Null: they do what they are told.
  RotorPlant* rotors() { return rotors_; }
  // True: the board is not in this process, or is emulated.
  bool has_board() const { return port_ != nullptr; }
  // The board's status before the hello.
  const BoardStatus& before() const { return before_; }
  // True: the board outlives this program, at the end of a line that may break.
  bool is_on_a_line() const { return claim_.has_value(); }
  // Asks until the board rests. Otherwise says why it does not, as a sentence. Call before the hello.
  std::optional<std::string> wait_for_rest();
  // Where the machine stands before the hello, or why nobody knows. Virtual and emulated machines stand at machine
  // zero. A real board is known by what an earlier command has written down, and by its counts.
  Result<KnownPosition, PlaceDoubt> place() const;
  // The machine stands there. Where nobody knows the place, but the board has gone on counting, it stands where it
  // stood for the command before. Call before the hello.
  void stand_as_counted();
  // Says where the machine stands, before the hello.
  void start_at(const KnownPosition& position) { session_->start_at(position); }
  // A virtual machine stands here in truth, whatever its board believes. Call before the board drives it.
  void stand_in_truth_at(const Point& place);
  // Greets the board, and waits until the machine is ready. False, with a message: the board does not suit.
  [[nodiscard]] bool greet(const Greeting& greeting, int& code);
  // A greeting by which the board is recognised later, if that is worth while.
  Greeting any_greeting() const;
  // What went to the board from the hello on, without the questions before it.
  std::uint64_t frames_sent() const { return session_->board().frames_sent() - frames_asked_; }
  std::uint64_t bytes_sent() const { return session_->board().bytes_sent() - bytes_asked_; }
  // A number for a session that is not the board's present one.
  std::uint16_t new_session_number() const;
  // Begins to give the board another session number, after the hello and at rest. board().ready() tells when it has it.
  void begin_session(std::uint16_t number);
  // The same, and waits. False, with a message: it does not answer.
  [[nodiscard]] bool name_session(std::uint16_t number, int& code);
  // Writes down what has become of the place, for the next command.
  void keep_place();

  // Sends what the board has executed to the virtual machine too. The virtual machine's motors stand at this place when
  // the program begins.
  void follow(Watchers& watchers, const Point& place);
  void catch_up();
  // Checks at the end whether the motors are where the counts say, as far as that is known. Otherwise says what
  // differs.
  std::optional<std::string> compare();

 private:
  OpenedMachine(const MachineDescription& machine, const MachineWish& wish);
  bool ask_first(const std::string& address, bool may_move, int& code);
  void write_down(const KnownPosition& position, const MotorSteps& zero_counts, const SessionNumbers& numbers);

  const MachineDescription& description_;
  std::unique_ptr<FittedPlant> plant_;
  RotorPlant* rotors_ = nullptr;  // plant_, if its motors obey physics
  VirtualMachine machine_;
  std::optional<VirtualLine> line_;
  std::unique_ptr<BoardPort> port_;
  bool plant_is_behind_ = true;
  std::unique_ptr<MachineSession> session_;
  std::unique_ptr<BoardSession> shadow_;
  BoardStatus before_;
  std::optional<BoardClaim> claim_;
  std::optional<KeptPlace> kept_place_;  // of a board that outlives this program
  SessionNumbers numbers_;
  bool greeted_ = false;
  std::uint64_t frames_asked_ = 0;
  std::uint64_t bytes_asked_ = 0;
};

// The words for a place, with the letters of the axes: "X1.000 Y-2.500".
std::string place_words(const MachineDescription& machine, const Point& place);
// "the machine is busy [machine.busy]".
std::string describe(const Refusal& refusal);
// Makes a request that may be refused. A refusal means that the machine is already where the request would lead.
void try_request(MachineSession& session, Request wanted);
// Turns the session until nothing is going on. Ctrl-C brakes. `look`, if any, is called after each turn.
void poll_until_end(OpenedMachine& machine, const std::function<void()>& look = {});

}  // namespace passo
