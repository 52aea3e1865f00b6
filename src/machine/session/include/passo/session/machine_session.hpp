// MachineSession: represents the machine for all clients. Everything that moves a machine goes through its session.
//
// Requests go in; a status and an ordered list of changes come out. A session never blocks, and has no thread and no
// clock. Its owner calls poll() repeatedly, in the board's simulated time or in real time.
//
//   owner:  session.request(…);  while (…) { session.poll(Seconds(0.02));  session.status();  session.take_changes(); }
//
// Invariants: the state changes only as the table in machine_state.hpp says. Each request is answered exactly once.
//
// There are two kinds of session. BoardMachineSession: for boards that execute steps planned here. GrblMachineSession
// (sender/): for boards that plan their own motion. abilities() lists what the machine cannot do.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/interpreter/interpreter.hpp"
#include "passo/session/board_storage.hpp"
#include "passo/session/machine_abilities.hpp"
#include "passo/session/machine_status.hpp"
#include "passo/session/numbered_settings.hpp"
#include "passo/session/request.hpp"

namespace passo {

class BoardMachineSession;
class HostSpindle;

class MachineSession {
 public:
  // What a program has found and set.
  struct ProgramResults {
    SavedParameters parameters;
    ToolTable tools;
  };

  virtual ~MachineSession() = default;
  MachineSession(const MachineSession&) = delete;
  MachineSession& operator=(const MachineSession&) = delete;

  [[nodiscard]] virtual Result<Ticket, Refusal> request(Request wanted) = 0;
  // Performs one bounded step. If the session can only wait for the board, time passes until something changes, but at
  // most `most`, which may be infinite only while something moves.
  virtual void poll(Seconds most) = 0;

  virtual MachineStatus status() const = 0;
  virtual std::vector<MachineChange> take_changes() = 0;
  virtual MachineState state() const = 0;
  // The board's time.
  virtual Seconds now() const = 0;
  // An activity is running or held.
  virtual bool busy() const = 0;
  // The board must be polled often: something is going on, or the board is expected to answer.
  virtual bool works() const = 0;
  // The reason why this board cannot control the machine, as a sentence without a full stop.
  virtual const std::string& trouble_words() const = 0;
  // The results of the current program, or otherwise of the last one. Empty: the last activity was not a program.
  virtual std::optional<ProgramResults> program_results() const = 0;
  // The reason why no program may start because of the switches: a closed limit switch can no longer stop the board at
  // that end. Empty: none.
  virtual std::optional<Refusal> closed_limit() const = 0;
  // The same for an unknown or lost position. Jogging is possible.
  virtual std::optional<Refusal> lost_place() const = 0;
  virtual MachineAbilities abilities() const { return {}; }
  // The files of the board. Null: it stores none.
  virtual BoardStorage* storage() { return nullptr; }
  // Returns the settings of a board that has its own; otherwise null.
  virtual NumberedSettings* numbered_settings() { return nullptr; }
  virtual const NumberedSettings* numbered_settings() const { return nullptr; }
  // Returns the spindle that this computer controls itself; null: the board switches it.
  virtual const HostSpindle* spindle() const { return nullptr; }
  // Returns the session if it has a board that executes our steps; otherwise null.
  virtual BoardMachineSession* as_board_session() { return nullptr; }
  virtual const BoardMachineSession* as_board_session() const { return nullptr; }

 protected:
  MachineSession() = default;
};

}  // namespace passo
