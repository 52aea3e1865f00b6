#include "run_signals.hpp"

#include <csignal>
#include <cstdlib>
#include <string_view>

#include "run_outputs.hpp"
#include <unistd.h>

namespace passo {
namespace {

volatile std::sig_atomic_t first_signal = 0;

extern "C" void end_on_signal(int signal) {
  OutputFile::remove_unfinished();
  std::_Exit(128 + signal);
}

extern "C" void brake_on_signal(int signal) {
  if (first_signal != 0) end_on_signal(signal);
  first_signal = signal;
  constexpr std::string_view words = "\npasso: brakes on the path; a second time leaves at once\n";
  static_cast<void>(!write(STDERR_FILENO, words.data(), words.size()));
}

}  // namespace

void end_on_signals() {
  std::signal(SIGINT, end_on_signal);
  std::signal(SIGTERM, end_on_signal);
}

void brake_on_signals() {
  std::signal(SIGINT, brake_on_signal);
  std::signal(SIGTERM, brake_on_signal);
}

int interrupted_by() {
  return first_signal;
}

}  // namespace passo
