// Runs a stranger's program, confined (confinement.hpp), until it ends or exceeds a limit. Whatever the program does is
// a result. Only what keeps this computer from running it is an error.
//
// The program is one process that may have threads. Its standard input is a given text; its environment has only PATH,
// HOME, TMPDIR and LANG. No process of it remains when the function returns.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "passo/base/result.hpp"

namespace passo {

struct ProgramLimits {
  unsigned processor_seconds = 5;
  unsigned waiting_seconds = 5;  // without using the processor, although it could
  unsigned total_seconds = 60;   // by the clock, however busy this computer is
  std::uint64_t memory = std::uint64_t{256} << 20;
  std::uint64_t output = std::uint64_t{1} << 20;  // standard output, standard error and files in its folder, together
};

struct ConfinedProgram {
  std::string folder;              // its folder and working directory (Confinement::folder); an absolute path
  std::vector<std::string> words;  // the command line; a program without a slash is looked for in /usr/bin and similar
  std::string input;               // at most 60,000 bytes
  std::vector<std::string> readable = {};  // as in Confinement
  bool unconfined = false;                 // only the limits apply; it may open, connect and start whatever it likes
  ProgramLimits limits = {};
  std::function<bool()> is_cancelled = nullptr;  // asked again and again; if true, the program is stopped (End::waits)
};

struct ConfinedRun {
  enum class End : std::uint8_t {
    exited,           // code: its exit code
    crashed,          // code: the signal
    processor_time,   // it used up its processor time
    waits,            // it waited for something that does not come
    too_much_output,  // or its files are too long, or too many
    not_started,      // code: errno of execve()
  };
  End end = End::exited;
  int code = 0;
  std::string output = {};    // standard output
  std::string messages = {};  // standard error
  double processor_seconds = 0;
  std::uint64_t peak_memory = 0;  // bytes in memory at the same time
};

// The error is a sentence with the reason.
Result<ConfinedRun, std::string> run_confined(const ConfinedProgram& program);

// How it ended, e.g. "crashed: Segmentation fault" or "used more than 5 s of processor time". Empty if it exited with
// code 0.
std::string describe_end(const ConfinedRun& run, const ProgramLimits& limits);

}  // namespace passo
