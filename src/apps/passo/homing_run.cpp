#include "homing_run.hpp"

#include <array>
#include <cstdio>
#include <memory>
#include <utility>

#include "board_words.hpp"
#include "program_input.hpp"
#include "run_signals.hpp"
#include <fmt/ranges.h>
#include <unistd.h>

#include "passo/activity/home_switches.hpp"
#include "passo/emulator/emulated_board.hpp"
#include "passo/transport/inquiry.hpp"

namespace passo {
namespace {

constexpr Seconds answer{2};

// The switches of an emulated board, which its steps close and open. They stay as long as the board.
void put_switches(const MachineDescription& machine, EmulatedBoard& board) {
  struct Switches {
    std::vector<TravelSwitch> all;
    std::vector<bool> closed;
    std::vector<std::int64_t> counts;
  };
  auto switches = std::make_shared<Switches>();
  switches->all = home_switches(machine, Point());
  switches->closed.assign(switches->all.size(), false);
  switches->counts = board.positions();
  const auto look = [switches, &board](std::size_t motor) {
    for (std::size_t i = 0; i < switches->all.size(); ++i) {
      const TravelSwitch& one = switches->all[i];
      if (one.motor != motor) continue;
      const bool closed = one.closed(switches->counts[motor], switches->closed[i]);
      if (closed == switches->closed[i]) continue;
      switches->closed[i] = closed;
      static_cast<void>(board.set_switch(static_cast<BoardInput>(one.input), closed));
    }
  };
  for (std::size_t motor = 0; motor < switches->counts.size(); ++motor) look(motor);
  board.on_step = [switches, look](std::uint64_t, std::size_t motor, bool down) {
    switches->counts[motor] += down ? -1 : 1;
    look(motor);
  };
}

const char* name_of(HomingStage stage) {
  switch (stage) {
    case HomingStage::seek: return "seeks its switch";
    case HomingStage::back_off: return "backs off";
    case HomingStage::latch: return "comes back slowly";
    case HomingStage::pull_off: return "pulls off";
  }
  return "";
}

// One line on a terminal, which is gone in the end.
class StageLine {
 public:
  explicit StageLine(bool shows) : shows_(shows && is_terminal(STDERR_FILENO)) {}
  ~StageLine() { show(""); }
  StageLine(const StageLine&) = delete;
  StageLine& operator=(const StageLine&) = delete;

  void look(const HomingPath& path) {
    if (path.axis() == nullptr) return;
    show(fmt::format("{} {}", letter_of(path.axis()->axis), name_of(path.stage())));
  }

 private:
  void show(const std::string& text) {
    if (!shows_ || text == shown_) return;
    shown_ = text;
    fmt::print(stderr, "\r\x1b[K{}", text);
    std::fflush(stderr);
  }

  bool shows_;
  std::string shown_;
};

void note_link_error(LinkError error, BoardPort& port, HomingReport& report) {
  report.code = error == LinkError::stopped ? "home.stopped" : "home.board";
  report.message = message_of(error);
  if (error != LinkError::stopped) return;
  const auto status = Inquiry(port).status(answer);
  if (!status) return;
  const std::vector<std::string> closed = switches_of(*status);
  if (!closed.empty()) report.message += fmt::format("; closed now: {}", fmt::join(closed, ", "));
}

void note_end(const Homing& homing, BoardPort& port, HomingReport& report) {
  report.axes = homing.path().homed();
  report.place = homing.place();
  if (homing.done()) return;
  if (homing.path().axis() != nullptr) report.axis = homing.path().axis()->axis;
  if (const auto error = homing.drive().link().error()) return note_link_error(*error, port, report);
  if (const auto fault = homing.path().fault()) {
    report.code = code_of(*fault);
    report.message = message_of(*fault);
    return;
  }
  report.code = "home.interrupted";
  report.message = "interrupted; it is not homed";
}

}  // namespace

std::string words_of(const HomingReport& report) {
  const std::string axis = report.axis ? fmt::format("homing {}: ", letter_of(*report.axis)) : "homing: ";
  return fmt::format("{}{} [{}]", axis, report.message, report.code);
}

std::string words_without_homing(const std::string& machine_file) {
  return machine_file + ": no axis has a switch to be homed by, a table [axis.X.home] [home.no-switch]";
}

HomingReport home_machine(const MachineDescription& machine, BoardRun* board, bool shows) {
  VirtualMachine own(static_cast<std::uint8_t>(machine.axes.size()), machine.board.clock,
                     machine.board.highest_event_rate);
  BoardPort* const port = board != nullptr ? &board->port() : nullptr;
  if (auto* const emulated = dynamic_cast<EmulatedBoard*>(port)) put_switches(machine, *emulated);
  if (port == nullptr) {
    for (const TravelSwitch& one : home_switches(machine, Point())) own.add_switch(one);
  }
  HomingReport report;
  Homing homing(machine, own, port != nullptr ? BoardLine::to_board(*port) : BoardLine());
  if (const auto words = homing.drive().unsuited()) {
    report.code = "home.board";
    report.message = *words;
    return report;
  }
  const Seconds from = homing.drive().now();
  {
    StageLine line(shows);
    while (homing.advance()) {
      if (interrupted_by() != 0 && !homing.drive().stopped()) homing.drive().stop();
      line.look(homing.path());
    }
  }
  report.time = homing.drive().now() - from;
  note_end(homing, port != nullptr ? *port : own, report);
  return report;
}

}  // namespace passo
