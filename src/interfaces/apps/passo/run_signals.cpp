#include "run_signals.hpp"

#include <csignal>
#include <cstdlib>
#include <string_view>

#include "program_input.hpp"
#include <unistd.h>

#include "passo/base/nameless_file.hpp"

namespace passo {
namespace {

volatile std::sig_atomic_t first_signal = 0;

extern "C" void end_on_signal(int signal) {
  NamelessFile::remove_unfinished();
  std::_Exit(128 + signal);
}

extern "C" void leave_on_signal(int signal) {
  constexpr std::string_view words = "\npasso: interrupted; nothing moved, and nothing was written\n";
  static_cast<void>(!::write(STDERR_FILENO, words.data(), words.size()));
  end_on_signal(signal);
}

extern "C" void note_signal(int signal) {
  if (first_signal != 0) {
    // A terminal that is closed may say so twice: from the shell, and by itself. Nobody has asked to leave at once.
    if (signal == SIGHUP) return;
    end_on_signal(signal);
  }
  first_signal = signal;
}

extern "C" void brake_on_signal(int signal) {
  const bool is_first = first_signal == 0;
  note_signal(signal);
  if (!is_first) return;
  constexpr std::string_view words = "\npasso: stopping on the path; press Ctrl-C again to quit immediately\n";
  static_cast<void>(!::write(STDERR_FILENO, words.data(), words.size()));
}

using Handler = void (*)(int);

void handle_with(Handler handler) {
  std::signal(SIGINT, handler);
  std::signal(SIGTERM, handler);
  // Who starts a command by nohup wants it to go on when the terminal is closed.
  if (std::signal(SIGHUP, handler) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
  outlive_readers();
}

}  // namespace

void end_on_signals() {
  handle_with(leave_on_signal);
}

void brake_on_signals() {
  handle_with(brake_on_signal);
}

void catch_signals() {
  handle_with(note_signal);
}

int interrupted_by() {
  return first_signal;
}

int exit_of_signal() {
  if (first_signal != 0) return 128 + first_signal;
  return fail(exit_failed, "ended without a known reason, which is a bug in Passo [passo.no-reason]");
}

void outlive_readers() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error of its write
}

}  // namespace passo
