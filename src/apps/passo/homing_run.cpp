#include "homing_run.hpp"

#include <cstdio>

#include "board_words.hpp"
#include "program_input.hpp"
#include "run_signals.hpp"
#include <fmt/ranges.h>
#include <unistd.h>

#include "passo/transport/inquiry.hpp"

namespace passo {
namespace {

constexpr Seconds answer{2};

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

HomingReport home_machine(const MachineDescription& machine, BoardRun* board, Plant& plant, bool shows) {
  VirtualMachine own(static_cast<std::uint8_t>(machine.axes.size()), machine.board.clock,
                     machine.board.highest_event_rate);
  BoardPort* const port = board != nullptr ? &board->port() : nullptr;
  if (port == nullptr) own.connect(plant);
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
