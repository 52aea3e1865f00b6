// OpenedMachine: a machine session on the board that the command line names, and what belongs to it: the plant behind a
// virtual or an emulated board, and a virtual machine that does what a real board has done, for counts and traces.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mid_run_changes.hpp"

#include "passo/activity/touch_box.hpp"
#include "passo/machine/virtual_line.hpp"
#include "passo/machine/virtual_machine.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/plant/ideal_plant.hpp"
#include "passo/session/machine_session.hpp"

namespace passo {

struct MachineWish {
  std::string board = "virtual";     // as parse_board_address() has it
  std::optional<CableCut> cut = {};  // the virtual machine is at the end of a line, which is cut
  std::vector<TouchBox> boxes = {};  // for the probe to touch, of a virtual or an emulated board
  bool may_move = false;             // another host may have left the board in motion
};

class OpenedMachine {
 public:
  // Null, and said why, where there is no such board, or it moves though it must not; `code`: what to exit with. A
  // board over a line has been asked how it is, and not been greeted.
  static std::unique_ptr<OpenedMachine> open(const MachineDescription& machine, const MachineWish& wish, int& code);

  MachineSession& session() { return *session_; }
  const MachineSession& session() const { return *session_; }
  // The board itself, or what does as the board has done.
  VirtualMachine& machine() { return machine_; }
  // A board that is not in this process, or an emulated one.
  bool has_board() const { return port_ != nullptr; }
  // How the board was before the hello.
  const BoardStatus& before() const { return before_; }
  // Asks until the board rests; false where it does not answer. Before the hello.
  [[nodiscard]] bool wait_for_rest();
  // Greets, and waits until the machine is ready. False, and said why, where the board does not suit. Where nobody has
  // to know the board again, the usual greeting does.
  [[nodiscard]] bool greet(const Greeting& greeting, int& code);
  Greeting usual_greeting() const { return {.session = has_board() || line_ ? std::uint16_t{1} : std::uint16_t{0}}; }

  // What a board has executed goes to the virtual machine too, whose motors stand at that place when the program
  // begins.
  void follow(Watchers& watchers, const Point& place);
  void catch_up();
  // At the end: whether the motors are where the counts say, as far as that is known; else what differs.
  std::optional<std::string> compare();

 private:
  OpenedMachine(const MachineDescription& machine, const MachineWish& wish);
  bool ask_first(const std::string& address, bool may_move, int& code);

  const MachineDescription& description_;
  IdealPlant plant_;
  VirtualMachine machine_;
  std::optional<VirtualLine> line_;
  std::unique_ptr<BoardPort> port_;
  bool plant_is_behind_ = true;
  std::unique_ptr<MachineSession> session_;
  std::unique_ptr<BoardSession> shadow_;
  BoardStatus before_;
};

// Turns until nothing is going on; Ctrl-C brakes. `look`, if any, is called after each turn.
void turn_to_the_end(MachineSession& session, const std::function<void()>& look = {});
// What became of a request that has been answered, and why.
struct Answered {
  Outcome outcome = Outcome::done;
  std::optional<ActivityFault> fault;
};
Answered answer_of(const std::vector<MachineChange>& changes, Ticket ticket);

}  // namespace passo
