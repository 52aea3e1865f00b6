#include "homing_run.hpp"

#include <cstdio>

#include "board_words.hpp"
#include "program_input.hpp"
#include "run_signals.hpp"
#include <fmt/format.h>
#include <unistd.h>

namespace passo {
namespace {

const char* name_of(HomingStage stage) {
  switch (stage) {
    case HomingStage::seek: return "seeks its switch";
    case HomingStage::look: return "checks its switch";
    case HomingStage::square: return "is squared";
    case HomingStage::back_off: return "backs off";
    case HomingStage::latch: return "approaches its switch again slowly";
    case HomingStage::pull_off: return "pulls off";
  }
  return "";
}

// Shows the present stage on one line of the terminal, and clears the line at the end.
class StageLine {
 public:
  explicit StageLine(bool shows) : shows_(shows && rewrites_lines(STDERR_FILENO)) {}
  ~StageLine() { show(""); }
  StageLine(const StageLine&) = delete;
  StageLine& operator=(const StageLine&) = delete;

  void update(const HomingPath& path) {
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

void record_end(BoardMachineSession& session, const Answered& answered, HomingReport& report) {
  const HomingPath* const path = session.homing();
  report.axes = path->homed();
  if (answered.outcome == Outcome::done) return;
  if (path->axis() != nullptr) report.axis = path->axis()->axis;
  if (answered.outcome == Outcome::stopped) {
    report.code = "home.interrupted";
    report.message = "interrupted; it is not homed";
    return;
  }
  report.code = answered.fault->code();
  report.message = answered.fault->message();
  if (const auto trouble = session.status().trouble) {
    report.code = *trouble == LinkError::stopped ? "home.stopped" : "home.board";
    if (*trouble == LinkError::stopped) report.message += closed_switches(session.board());
  }
}

}  // namespace

std::string describe(const HomingReport& report) {
  const std::string axis = report.axis ? fmt::format("homing {}: ", letter_of(*report.axis)) : "homing: ";
  return fmt::format("{}{} [{}]", axis, report.message, report.code);
}

std::string words_without_homing(const std::string& machine_file) {
  return machine_file + ": no axis has a homing switch (table [axis.X.home]) [home.no-switch]";
}

HomingReport home_machine(MachineConnection& machine, bool shows) {
  BoardMachineSession& session = machine.session();
  HomingReport report;
  const Seconds from = session.now();
  const auto ticket = session.request(request::Home{});
  if (!ticket) {
    report.code = code_of(ticket.error().code());
    report.message = ticket.error().message();
    return report;
  }
  {
    StageLine line(shows);
    poll_until_end(machine, [&] { line.update(*session.homing()); });
  }
  report.time = session.now() - from;
  record_end(session, answer_of(session.take_changes(), *ticket), report);
  return report;
}

}  // namespace passo
