// The commands of `passo`, one function each. command_line.cpp fills in the arguments; each command returns an exit
// code.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace passo {

// What a script may rely on.
enum ExitCode : int {
  exit_done = 0,
  exit_failed = 1,       // something else: a file that cannot be written, an interruption by a fault
  exit_bad_program = 2,  // the user's program or command line is wrong
  exit_bad_machine = 3,  // the machine's file is wrong
  exit_interrupted = 130,
};

struct ProgramArguments {
  std::string program;        // "-": standard input
  bool block_delete = false;  // skip lines that start with '/'
  bool inches = false;        // until the program says G20 or G21
};

struct RunArguments {
  ProgramArguments program;
  std::string machine;
  std::vector<std::string> pictures;  // .svg or .png
  std::vector<std::string> traces;    // .vcd or .csv
  std::string report;                 // .json or text
  bool json = false;                  // the summary on standard output as JSON
  bool quiet = false;
};
int run(const RunArguments& arguments);

struct CheckArguments {
  ProgramArguments program;
  std::string machine;
  bool json = false;
};
int check(const CheckArguments& arguments);

struct CanonArguments {
  ProgramArguments program;
  std::string output;  // empty: standard output
};
int canon(const CanonArguments& arguments);

struct MachineArguments {
  std::string machine;
};
int machine(const MachineArguments& arguments);

struct RampArguments {
  std::string method;                  // exact, recursive, table
  std::optional<double> clock;         // Hz
  std::optional<double> acceleration;  // rad/s²
  std::optional<double> max_rate;      // steps/s, as the next
  std::optional<double> start_rate;
  std::optional<double> jerk;  // rad/s³
  std::optional<std::int32_t> steps_per_turn;
  std::optional<std::int32_t> table_size;
  std::optional<std::int64_t> steps;
  std::optional<std::int64_t> move;
  std::optional<std::int64_t> stop_after;
  bool whole_ticks = false;
  bool limit = false;
  bool json = false;
  std::string picture;
  std::string output;  // empty: standard output
};
int ramp(const RampArguments& arguments);

}  // namespace passo
