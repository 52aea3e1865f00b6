#include "operator_prompt.hpp"

#include <cstdio>
#include <utility>

#include "machine_connection.hpp"
#include "program_input.hpp"
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include "passo/link/await.hpp"

namespace passo {
namespace {

// How often the machine is heard while the program waits for somebody.
constexpr Seconds between_looks{0.05};
constexpr std::size_t most_told = 5;

// Whether Enter is pressed within this time.
bool enter_was_pressed(Seconds within) {
  pollfd input{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
  if (poll(&input, 1, static_cast<int>(within.value() * 1e3)) <= 0) return false;
  char typed[256];
  return read(STDIN_FILENO, typed, sizeof typed) > 0;
}

std::string what(const OperatorWait& wait) {
  switch (wait.kind) {
    case Action::Kind::tool_change: return fmt::format("tool {} (M6)", wait.tool);
    case Action::Kind::optional_stop: return "optional stop (M1)";
    default: return "program stop (M0)";
  }
}

}  // namespace

bool asks_operator() {
  return is_terminal(STDIN_FILENO) && is_terminal(STDERR_FILENO);
}

std::string describe(const OperatorWait& wait) {
  std::string words = fmt::format("line {}: {}", wait.line, what(wait));
  if (wait.words.empty()) return words;
  words += ": " + wait.words;
  for (std::size_t end = 0; (end = words.find('\n', end)) != std::string::npos;) words.replace(end, 1, ", ");
  return words;
}

void ProgramStops::watch(const PathItem& item) {
  const auto* action = std::get_if<Action>(&item);
  if (action == nullptr) return;
  using Kind = Action::Kind;
  const bool stops =
      action->kind == Kind::program_stop || action->kind == Kind::optional_stop || action->kind == Kind::tool_change;
  if (!stops) return;
  const std::uint32_t line = action->source.line;
  if (++count_ <= most_told) {
    stops_.push_back({.kind = action->kind, .tool = action->tool, .line = line, .words = words_.at(line)});
  }
  words_.pass(line);
}

std::string ProgramStops::words() const {
  std::string words;
  for (const OperatorWait& stop : stops_) words += (words.empty() ? "" : "; ") + describe(stop);
  if (count_ > most_told) words += fmt::format("; and {} more", count_ - most_told);
  return words;
}

void ProgramStops::tell(const RunArguments& arguments) const {
  if (count_ == 0 || arguments.quiet) return;
  fmt::print(stderr,
             "passo: note: {} stops for the operator at {}. The simulated machine skips this stop. A real board, or a "
             "run in a terminal, waits; --yes skips it there too\n",
             arguments.program.program, words());
}

Seconds OperatorPrompt::poll(MachineSession& session) {
  // This runs in each turn, and making the status takes time. So the status is made only if the program may wait.
  if (session.state() == MachineState::run) {
    asked_ = false;
    return endless;
  }
  const auto wait = session.status().waits_for;
  if (!wait) {
    asked_ = false;
    return endless;
  }
  if (!asks_operator()) {
    if (!fault_) {
      fault_ = ActivityFault{MachineFault::program_waits, {{"program", program_}, {"wait", describe(*wait)}}};
      try_request(session, request::Stop{});
    }
    return endless;
  }
  if (hears_enter(*wait)) try_request(session, request::OperatorDone{});
  return Seconds(0);
}

bool OperatorPrompt::hears_enter(const OperatorWait& wait) {
  if (!std::exchange(asked_, true)) {
    fmt::print(stderr, "{}{} waits at {}. Press Enter to continue. ", rewrites_lines(STDERR_FILENO) ? "\r\033[K" : "",
               program_, describe(wait));
    std::fflush(stderr);
  }
  return enter_was_pressed(between_looks);
}

}  // namespace passo
