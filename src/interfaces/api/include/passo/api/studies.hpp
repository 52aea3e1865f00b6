// Studies: what takes longer than a look, worked out beside the machine: whether the motors have the torque for a
// program, and which limits they could have.
//
// Place: the API's view of a helper that the program provides. One order at a time; a new one takes the place of the
// one before. Memory and time are bounded by whoever implements this.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace passo {

struct StudyOrder {
  enum class Kind : std::uint8_t {
    motors,  // as `passo check`: the torque that each line of a program needs
    tune,    // as `passo tune`: limits for the machine's motors, with their curves
  };
  Kind kind = Kind::motors;
  std::string machine;  // the text of a machine file
  // Of a program:
  std::string program;               // its text
  std::string dialect;               // "linuxcnc" or "grbl"
  std::string parameters;            // the text of a parameter file: offsets
  std::string tools;                 // the text of a tool table; empty: none
  std::vector<std::string> options;  // of `tune`: "--margin=0.4"
};

struct StudyResult {
  enum class State : std::uint8_t { none, running, done, failed };
  State state = State::none;
  std::string words = {};   // what was said; why it failed
  std::string report = {};  // JSON, as the command prints it
};

class Studies {
 public:
  virtual ~Studies() = default;
  // False: none can begin.
  virtual bool begin(const StudyOrder& order) = 0;
  // How it goes. Call often: it is cheap while nothing changes.
  virtual const StudyResult& result() = 0;
  // Of `motors`: CSV, a line `line,load` for each line of the program that moves. Empty: there is none.
  virtual std::string loads() const = 0;
  // Of `tune`: torque over speed, SVG. Empty: there is none.
  virtual std::string picture() const = 0;
};

}  // namespace passo
