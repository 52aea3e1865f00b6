// FirstContact: the serial ports of the server's computer, and the machine with Grbl that answers on one of them.
//
// Position in the pipeline: the API's interface to a service that the program provides. Only begin() opens a port, in a
// process of its own, so that no machine waits for it. The process reads what the board says of itself ($I, $$), and
// writes nothing to it.
#pragma once

#include <cstdint>
#include <string>

#include "passo/base/result.hpp"

namespace passo {

struct ContactResult {
  enum class State : std::uint8_t { none, running, done, failed };
  State state = State::none;
  std::string device = {};  // the port, or the address in the network
  std::string board = {};   // its address for --board
  std::string words = {};   // messages, including the reason for a failure
  std::string report = {};  // the machine file made from the settings, as JSON, as `passo machine --from` prints it
};

struct KeptMachine {
  std::string path;
  std::string command;  // the command line that starts this server with that machine and board
};

class FirstContact {
 public:
  virtual ~FirstContact() = default;
  // The address of the board of this server: "virtual", "grbl:/dev/ttyUSB0".
  virtual const std::string& board() const = 0;
  // The ports, as JSON: {"ports": […], "sees_all_programs": true}, as in `passo board list --json`. Opens none. Takes
  // some milliseconds.
  virtual std::string ports() = 0;
  // Connects to a board, and reads the machine. Opening a port restarts an Arduino. `board`: its address for --board.
  // Returns false if a board is being read, or if the process cannot be started.
  virtual bool begin(const std::string& device, const std::string& board) = 0;
  // Returns the current state. Can be called often: it is cheap if nothing has changed.
  virtual const ContactResult& result() = 0;
  // Returns true if there is a machine file of that name.
  virtual bool keeps(const std::string& name) const = 0;
  // Writes a new machine file for the machine that was read. `name`: a file name without folders. The error is the
  // reason.
  virtual Result<KeptMachine, std::string> keep(const std::string& name, const std::string& text) = 0;
};

}  // namespace passo
