#include "operator_prompt.hpp"

#include <cstdio>
#include <utility>

#include "machine_connection.hpp"
#include "program_input.hpp"
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include "passo/drive/host_spindle.hpp"
#include "passo/link/await.hpp"

namespace passo {
namespace {

// How often the machine is heard while the program waits for somebody.
constexpr Seconds between_looks{0.05};

// Whether Enter is pressed within this time.
bool enter_was_pressed(Seconds within) {
  pollfd input{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
  if (poll(&input, 1, static_cast<int>(within.value() * 1e3)) <= 0) return false;
  char typed[256];
  return read(STDIN_FILENO, typed, sizeof typed) > 0;
}

}  // namespace

bool asks_operator() {
  return is_terminal(STDIN_FILENO) && is_terminal(STDERR_FILENO);
}

void tell_stops(const ProgramStops& stops, const RunArguments& arguments) {
  if (stops.count() == 0 || arguments.quiet) return;
  fmt::print(stderr,
             "passo: note: {} stops for the operator at {}. The simulated machine skips this stop. A real board, or a "
             "run in a terminal, waits; --yes skips it there too\n",
             arguments.program.program, stops.words());
}

Seconds OperatorPrompt::poll(MachineSession& session) {
  // This runs in each turn, and making the status takes time. So the status is made only if the program may wait.
  if (session.state() == MachineState::run) {
    asked_ = false;
    return endless;
  }
  if (const HostSpindle* const spindle = session.spindle(); spindle != nullptr && spindle->status().has_failed()) {
    return poll_failed_spindle(session, spindle->status().fault);
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

// The program is held, and the spindle is off. Enter clears the fault and continues, if its cause is gone.
Seconds OperatorPrompt::poll_failed_spindle(MachineSession& session, const Sentence& fault) {
  if (!asks_operator()) {
    if (!fault_) {
      fault_ = ActivityFault{MachineFault::spindle_failed, {{"why", fault.text}}};
      try_request(session, request::Stop{});
    }
    return endless;
  }
  if (!std::exchange(asked_, true)) {
    fmt::print(stderr, "{}{}: held, because {} [{}]. Press Enter to continue, Ctrl-C to end. ",
               rewrites_lines(STDERR_FILENO) ? "\r\033[K" : "", program_, fault.text, fault.code);
    std::fflush(stderr);
  }
  if (!enter_was_pressed(between_looks)) return Seconds(0);
  asked_ = false;
  if (const auto refused = session.request(request::Resume{}); !refused) note(describe(refused.error()));
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
