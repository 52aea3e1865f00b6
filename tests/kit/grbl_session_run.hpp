// A GrblMachineSession on a StrictGrbl, in virtual time.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kit/strict_grbl.hpp"
#include <gtest/gtest.h>

#include "passo/sender/grbl_machine_session.hpp"

namespace passo::test {

// The line to a StrictGrbl, or to a board on one, whose time passes while somebody waits.
template <class Board>
class VirtualGrblPort final : public GrblPort {
 public:
  explicit VirtualGrblPort(Board& grbl) : grbl_(grbl) {}

  bool unplugged = false;
  bool is_usb = false;  // it is seen when it is plugged in again
  std::string sent;     // all bytes

  Seconds now() const override { return now_; }
  void send(std::string_view bytes) override {
    sent += bytes;
    if (!unplugged) grbl_.receive(bytes);
  }
  std::string receive(Seconds most) override {
    const Seconds step = std::min(most, Seconds(0.005));
    grbl_.run(step.value());
    now_ += step;
    std::string came = grbl_.take_output();
    broken_ = broken_ || unplugged;
    return unplugged ? std::string() : came;
  }
  bool is_broken() const override { return broken_; }
  bool has_returned() override { return is_usb && !unplugged; }
  bool open_again() override {
    broken_ = unplugged;
    return !unplugged;
  }

 private:
  Board& grbl_;
  Seconds now_{0};
  bool broken_ = false;
};

// A router with the travel of a StrictGrbl's axes.
inline MachineDescription strict_router(MachineDescription machine) {
  for (AxisDescription& axis : machine.axes) {
    axis.travel_low = -200;
    axis.travel_high = 200;
    axis.velocity = MmPerSecond(50);
    axis.acceleration = MmPerSecond2(500);
  }
  return machine;
}

inline StrictGrbl& strict_in(StrictGrbl& board) {
  return board;
}
// Of a board whose inner machine it is.
template <class Board>
StrictGrbl& strict_in(Board& board) {
  return board.inner();
}

template <class Board>
class GrblSessionRunOn {
 public:
  // `set_up`: what the machine is, before it is switched on.
  explicit GrblSessionRunOn(MachineDescription machine, const std::function<void(StrictGrbl&)>& set_up = {},
                            Board its_board = Board())
      : board(std::move(its_board)), description(strict_router(std::move(machine))) {
    for (int axis = 0; axis < 3; ++axis) {
      grbl.put(110 + axis, 3000);
      grbl.put(120 + axis, 500);
      grbl.put(130 + axis, 200);
    }
    if (set_up) set_up(grbl);
    board.restart();
  }
  ~GrblSessionRunOn() {
    collect();
    if (!session.busy()) EXPECT_TRUE(unanswered.empty()) << unanswered.size() << " requests have no answer";
  }
  GrblSessionRunOn(const GrblSessionRunOn&) = delete;
  GrblSessionRunOn& operator=(const GrblSessionRunOn&) = delete;

  // Polls until is_so() returns true. Returns false after `most`.
  bool play(const std::function<bool()>& is_so, Seconds most = Seconds(120)) {
    for (const Seconds end = session.now() + most; session.now() < end;) {
      collect();
      if (is_so()) return true;
      session.poll(Seconds(0.02));
    }
    collect();
    return is_so();
  }
  bool play_for(Seconds time) {
    const Seconds end = session.now() + time;
    return play([&] { return session.now() >= end; });
  }
  bool play_until(MachineState state, Seconds most = Seconds(120)) {
    return play([&] { return session.state() == state; }, most);
  }
  bool go_online() { return play_until(MachineState::idle, Seconds(10)); }

  std::optional<Ticket> ask(Request wanted) {
    const auto ticket = session.request(std::move(wanted));
    if (!ticket) {
      refusal = ticket.error();
      return {};
    }
    unanswered.push_back(*ticket);
    return *ticket;
  }
  // Asks, and plays until the answer has come.
  std::optional<MachineChange> ask_and_wait(Request wanted, Seconds most = Seconds(300)) {
    const auto ticket = ask(std::move(wanted));
    if (!ticket) return {};
    play([&] { return answer_to(*ticket).has_value(); }, most);
    return answer_to(*ticket);
  }
  std::optional<MachineChange> answer_to(Ticket ticket) const {
    for (const MachineChange& one : changes) {
      if (one.kind == MachineChange::Kind::answered && one.ticket == ticket) return one;
    }
    return {};
  }
  bool has_changed_to(MachineState state) const {
    return std::ranges::any_of(changes, [&](const MachineChange& one) {
      return one.kind == MachineChange::Kind::state && one.state == state;
    });
  }
  std::size_t count(MachineChange::Kind kind) const {
    return static_cast<std::size_t>(
        std::ranges::count_if(changes, [&](const MachineChange& one) { return one.kind == kind; }));
  }

  Board board;
  StrictGrbl& grbl = strict_in(board);
  VirtualGrblPort<Board> port{board};
  MachineDescription description;
  GrblMachineSession session{description, port};
  std::vector<MachineChange> changes;
  std::vector<Ticket> unanswered;
  std::optional<Refusal> refusal;

 private:
  // Each state follows from the one before, and each ticket is answered once.
  void collect() {
    for (MachineChange& change : session.take_changes()) {
      if (change.kind == MachineChange::Kind::answered) {
        const auto found = std::ranges::find(unanswered, change.ticket);
        EXPECT_NE(found, unanswered.end()) << "ticket " << change.ticket << " was answered twice";
        if (found != unanswered.end()) unanswered.erase(found);
      }
      if (change.kind == MachineChange::Kind::state) {
        const bool follows = std::ranges::any_of(
            transitions, [&](const Transition& one) { return one.from == last_ && one.to == change.state; });
        EXPECT_TRUE(follows) << name_of(last_) << " to " << name_of(change.state);
        last_ = change.state;
      }
      changes.push_back(std::move(change));
    }
  }

  MachineState last_ = MachineState::offline;
};

using GrblSessionRun = GrblSessionRunOn<StrictGrbl>;

inline request::Start grbl_start(const std::string& text) {
  request::Start start{.program = ProgramReader::from_text("part.ngc", text), .options = {}};
  start.options.dialect = Dialect::grbl;
  return start;
}

}  // namespace passo::test
