// Measures the cost of a part of the benchmark, or of another program.
#pragma once

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace passo {

// Returns the CPU time of this process (RUSAGE_SELF), or of its terminated child processes (RUSAGE_CHILDREN).
inline double cpu_seconds(int who) {
  rusage usage{};
  getrusage(who, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

struct Cost {
  double seconds = 0;    // wall time
  double mebibytes = 0;  // peak memory
};

// Runs a command and discards its output. Its memory includes the current memory of this process, which should be
// small.
inline Cost cost_of(const std::vector<std::string>& command) {
  const auto start = std::chrono::steady_clock::now();
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    std::vector<char*> arguments;
    for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));  // NOLINT
    arguments.push_back(nullptr);
    std::freopen("/dev/null", "w", stdout);
    execv(arguments[0], arguments.data());
    std::_Exit(127);
  }
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  return {.seconds = elapsed.count(), .mebibytes = static_cast<double>(usage.ru_maxrss) / 1024};
}

}  // namespace passo
