// Studies: analyses that take longer than a request, run without blocking the machine: whether the motors have enough
// torque for a program, and suitable limits for the motors.
//
// Position in the pipeline: the API's interface to a service that the program provides. It processes one order at a
// time; a new one replaces it. The implementation must limit memory and time.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace passo {

struct StudyOrder {
  enum class Kind : std::uint8_t {
    motors,  // as `passo check`: the torque needed by each line of a program
    tune,    // as `passo tune`: limits for the machine's motors, with their curves
  };
  Kind kind = Kind::motors;
  std::string machine;  // contents of the machine file
  // For a program:
  std::string program;               // contents of the program
  std::string dialect;               // "linuxcnc" or "grbl"
  std::string parameters;            // contents of the parameter file, with the offsets
  std::string tools;                 // contents of a tool table; empty: none
  std::vector<std::string> options;  // for `tune`: "--margin=0.4"
};

struct StudyResult {
  enum class State : std::uint8_t { none, running, done, failed };
  State state = State::none;
  std::string words = {};   // messages, including the reason for a failure
  std::string report = {};  // report in JSON, as printed by the command
};

class Studies {
 public:
  virtual ~Studies() = default;
  // Starts an order. Returns false if it cannot be started.
  virtual bool begin(const StudyOrder& order) = 0;
  // Returns the current state. Can be called often: it is cheap if nothing has changed.
  virtual const StudyResult& result() = 0;
  // For `motors`: a CSV with a row `line,load` for each line of the program that moves. Empty: there is none.
  virtual std::string loads() const = 0;
  // For `tune`: torque over speed, SVG. Empty: there is none.
  virtual std::string picture() const = 0;
};

}  // namespace passo
