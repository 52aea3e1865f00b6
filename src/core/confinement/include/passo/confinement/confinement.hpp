// Confinement: what a process may do that runs a stranger's program. A child process confines itself after fork() and
// before execve(); it cannot undo that.
//
// Three mechanisms of Linux work together, none of which needs root:
//   resource limits (setrlimit)   processor time, memory, file size
//   Landlock (Linux 5.13)         which files may be opened, created, executed and removed
//   a seccomp filter              no network, no other processes, no signals to them, no changes of the modes, owners
//                                 and times of files, which Landlock does not cover
// Linux up to 6.1 lacks parts of Landlock (truncate, TCP, signals); the filter covers these on every version.
//
// What remains possible: to see that a file exists, and its size and time (stat), and to list no folder.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "passo/base/result.hpp"

namespace passo {

// 0: no limit.
struct ResourceLimits {
  unsigned processor_seconds = 0;  // of all threads; SIGXCPU then, SIGKILL a second later
  std::uint64_t memory = 0;        // bytes of address space
  std::uint64_t file_size = 0;     // bytes of the longest file; SIGXFSZ
};
// Limits this process and those that it starts, each for itself.
void limit_resources(const ResourceLimits& limits);

struct Confinement {
  std::string folder;                 // may be read, written and executed, with everything below it
  std::vector<std::string> readable;  // files and folders that may be read and executed; missing ones are ignored
  bool may_start_processes = false;
};

// The system's programs and libraries, which an interpreter needs: /usr, /bin, /lib and similar, and /dev/null.
const std::vector<std::string>& system_folders();

// Whether this kernel can confine a process; if not, the error is a sentence with the reason.
Status<std::string> check_confinement();

// Confines this process for good; also drops root's privileges. The error is a sentence with the reason. The process
// must then end, since a part of the confinement may be missing.
Status<std::string> confine(const Confinement& confinement);

}  // namespace passo
