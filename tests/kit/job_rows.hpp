// Rows of figures about many random jobs, for scripts/mixture_table.sh: each job runs in a process of its own, so a job
// that crashes or does not end is a row like any other.
//
// PASSO_ROWS=1 PASSO_SEED=S PASSO_RUNS=N prints the rows of the programs S to S + N - 1. A test without PASSO_ROWS
// judges the jobs as usual.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>

#include "kit/random_gcode.hpp"
#include "kit/seed.hpp"
#include <sys/wait.h>
#include <unistd.h>

namespace passo::test {

inline bool prints_rows() {
  return number_of("PASSO_ROWS", 0) != 0;
}

// Returns which limits the machine has, and on which axes: e.g. "jerk=some torque=none backlash=all starts=none
// rotary=some".
inline std::string mixture_of(const MachineDescription& machine) {
  const auto share = [&](const char* name, const auto& has) {
    const auto count = static_cast<std::size_t>(std::ranges::count_if(machine.axes, has));
    return std::string(name) + (count == 0 ? "=none" : count == machine.axes.size() ? "=all" : "=some");
  };
  return share("jerk", [](const AxisDescription& axis) { return axis.jerk.value() > 0; }) +
         share(" torque", [](const AxisDescription& axis) { return axis.follows_torque(); }) +
         share(" backlash", [](const AxisDescription& axis) { return axis.screw.has_value(); }) +
         share(" starts", [](const AxisDescription& axis) { return axis.start_stop.value() > 0; }) +
         share(" rotary", [](const AxisDescription& axis) { return is_rotary(axis.axis); });
}

// Prints what `rows_of` returns for each job: lines of fields, separated by tabs. A job may take two minutes.
template <class Rows>
void print_job_rows(Machines machines, const Rows& rows_of) {
  constexpr unsigned most_seconds = 120;
  const std::uint64_t first = first_seed(1);
  const std::uint64_t runs = number_of("PASSO_RUNS", 1);
  for (std::uint64_t number = first; number < first + runs; ++number) {
    std::fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
      alarm(most_seconds);
      Random random = Random::of(number);
      const RandomJob job = RandomJob::of(machines, number, random);
      std::fputs(rows_of(number, job, random).c_str(), stdout);
      std::fflush(stdout);
      _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    if (WIFSIGNALED(status) == 0) continue;
    Random random = Random::of(number);
    const RandomJob job = RandomJob::of(machines, number, random);
    std::printf("killed\t%llu\t%s\tby signal %d\n", static_cast<unsigned long long>(number),
                mixture_of(job.machine).c_str(), WTERMSIG(status));
  }
}

}  // namespace passo::test
