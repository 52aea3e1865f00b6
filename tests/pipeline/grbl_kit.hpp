// A sender on a Grbl controller around a session on a virtual machine, in virtual time; and a player of transcripts.
//
// A transcript is a text file, line by line:
//   -> G0 X1      the sender sends this line
//   => \x18       the sender sends these bytes, without a line end; \xHH is a byte
//   <- ok         the controller's next line; a * stands for any characters
//   .. 0.5        so many seconds pass
//   # words       for people
#pragma once

#include <cstdlib>
#include <deque>
#include <fstream>
#include <sstream>
#include <string>

#include "kit/example_machine.hpp"
#include <fnmatch.h>

#include "passo/activity/machine_plant.hpp"
#include "passo/activity/stage_options.hpp"
#include "passo/grbl/grbl_controller.hpp"
#include "passo/machine/virtual_machine.hpp"
#include "passo/session/board_machine_session.hpp"

namespace passo::test {

inline InterpreterOptions in_grbl(const MachineDescription& machine) {
  InterpreterOptions options;
  options.dialect = Dialect::grbl;
  options.more_grbl_axes = more_grbl_axes(machine);
  return options;
}

class GrblRun {
 public:
  explicit GrblRun(const MachineDescription& machine = example_machine("router"),
                   const KnownPosition& start = at_zero(), const std::vector<Touchable>& touchables = {})
      : description_(machine),
        board_(machine.motor_count(), machine.board.clock, machine.board.highest_event_rate,
               static_cast<std::size_t>(machine.board.held_items)),
        plant_(plant_of(machine, start.place, touchables)),
        session_(description_, board_, {.tells_place = true, .start = start, .needs_place = true}),
        program_(description_, in_grbl(description_), start.place),
        grbl_(description_, session_, program_) {
    board_.connect(plant_);
    while (session_.state() == MachineState::offline) session_.poll(Seconds(0.01));
  }

  static KnownPosition at_zero() { return {.place = Point(), .trust = Trust::commanded}; }

  VirtualMachine& board() { return board_; }
  BoardMachineSession& session() { return session_; }
  StreamedProgram& program() { return program_; }
  GrblController& grbl() { return grbl_; }
  const MachineDescription& description() const { return description_; }

  void send(const std::string& bytes) { grbl_.receive(bytes); }
  void poll(Seconds most = Seconds(0.005)) {
    session_.poll(most);
    grbl_.poll(session_.take_changes());
    collect();
  }
  void collect() {
    for (const std::string& text : grbl_.take_replies()) {
      writes.push_back(text);
      std::istringstream lines(text);
      for (std::string line; std::getline(lines, line);) {
        while (!line.empty() && line.back() == '\r') line.pop_back();
        if (!line.empty()) replies.push_back(line);
      }
    }
  }
  void pass(Seconds time) {
    for (const Seconds end = session_.now() + time; session_.now() < end;) poll();
  }
  // False: that did not come about in time.
  template <class Condition>
  bool turn_until(Condition condition, Seconds within = Seconds(600)) {
    const Seconds end = session_.now() + within;
    for (int turns = 0; !condition() && session_.now() < end && turns < 10'000'000; ++turns) poll();
    return condition();
  }
  // The next line of the controller. Empty: none came within a minute.
  std::string reply() {
    turn_until([&] { return !replies.empty(); }, Seconds(60));
    if (replies.empty()) return {};
    std::string line = replies.front();
    replies.pop_front();
    return line;
  }
  std::string status() {
    send("?");
    collect();
    std::string last;
    for (const std::string& line : replies) last = line;
    if (!replies.empty()) replies.pop_back();
    return last;
  }
  bool is(const std::string& state) { return status().starts_with("<" + state); }

  std::deque<std::string> replies;  // not taken yet, line by line
  std::vector<std::string> writes;  // all, as they were written

 private:
  MachineDescription description_;
  VirtualMachine board_;
  IdealPlant plant_;
  BoardMachineSession session_;
  StreamedProgram program_;
  GrblController grbl_;
};

inline std::string with_bytes(const std::string& text) {
  std::string bytes;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text.compare(i, 2, "\\x") != 0) {
      bytes += text[i];
      continue;
    }
    bytes += static_cast<char>(std::strtol(text.substr(i + 2, 2).c_str(), nullptr, 16));
    i += 3;
  }
  return bytes;
}

inline void play(GrblRun& run, const std::string& path) {
  std::ifstream file(path);
  ASSERT_TRUE(file) << path;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    const std::string what = line.substr(0, 2);
    const std::string rest = line.size() > 3 ? line.substr(3) : "";
    if (what.empty() || what[0] == '#') continue;
    if (what == "->") {
      run.send(rest + "\n");
    } else if (what == "=>") {
      run.send(with_bytes(rest));
    } else if (what == "..") {
      run.pass(Seconds(std::stod(rest)));
    } else {
      ASSERT_EQ(what, "<-") << path << ":" << number;
      const std::string reply = run.reply();
      std::string pattern;
      for (const char c : rest) pattern += c == '[' || c == ']' || c == '?' ? std::string("\\") + c : std::string(1, c);
      EXPECT_EQ(fnmatch(pattern.c_str(), reply.c_str(), 0), 0)
          << path << ":" << number << "\n  expected " << rest << "\n  heard    " << reply;
    }
  }
  run.pass(Seconds(0.2));
  EXPECT_TRUE(run.replies.empty()) << path << ": heard besides: " << run.replies.front();
}

}  // namespace passo::test
