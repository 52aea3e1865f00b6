// BoardSettings: the settings of a Grbl board ($$), for the API: shown, written one by one with read-back, saved,
// compared with a file and restored from one.
//
// Position in the pipeline: the API's interface to a service that the program provides. It processes one order at a
// time, without blocking the machine. Nothing is written without an order that names the values.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace passo {

struct SettingsOrder {
  enum class Kind : std::uint8_t { read, write, compare, restore };
  Kind kind = Kind::read;
  std::vector<std::pair<std::string, std::string>> values = {};  // write: "$110", "500"
  std::string file = {};                                         // compare, restore: contents of a file of settings
};

struct SettingsResult {
  enum class State : std::uint8_t { none, running, done, failed };
  State state = State::none;
  std::string board = {};   // its address
  std::string words = {};   // messages, including the reason for a failure
  std::string report = {};  // firmware, settings, changes and differences, as `passo board settings --json` prints them
  std::string file = {};    // the settings as a file
};

class BoardSettings {
 public:
  virtual ~BoardSettings() = default;
  // Returns true if there is a board whose settings can be read.
  virtual bool has_board() const = 0;
  // Begins an order. Returns false if the board is not at rest, or if it works at another order.
  virtual bool begin(const SettingsOrder& order) = 0;
  // Returns the current state. Can be called often: it is cheap if nothing has changed.
  virtual const SettingsResult& result() = 0;
};

}  // namespace passo
