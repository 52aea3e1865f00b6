// Interpreter: blocks -> operations. Modal state, parameters, O-words, offsets; RS274/NGC in LinuxCNC's dialect.
//
// Pulled: each next() gives one operation. Errors in the program are collected; after an error in a block the
// interpreter goes on with the next one where that makes sense, so that one pass finds them all.
#pragma once

#include <memory>

#include "passo/base/source.hpp"
#include "passo/diagnostics/diagnostic.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/interpreter/operation.hpp"

namespace passo {

struct InterpreterOptions {
  bool block_delete = false;            // lines that start with '/' are skipped
  LengthUnits units = LengthUnits::mm;  // before the program says G20 or G21
  Point start;                          // machine position at the start
  // Passes of a loop without any operation between, before it is stopped with a diagnostic.
  std::uint64_t idle_passes = 1'000'000;
  // Who answers when the program asks the machine (probe, inputs, #<_task>): a preview as LinuxCNC's `rs274` does,
  // where a probe move ends 0.254 mm before its end and inputs are 0; or a machine that has neither probe nor inputs.
  bool on_machine = false;
  // How often a main program that ends with M99 runs; 0: without end.
  std::uint64_t main_passes = 1;
  int spindles = 1;          // 1 to 8
  double orient_offset = 0;  // degrees that M19 adds
  bool user_codes = false;   // M100 to M199 are allowed
};

class Interpreter final : public Source<Operation> {
 public:
  Interpreter(ProgramReader reader, const InterpreterOptions& options, Diagnostics& diagnostics);
  ~Interpreter() override;

  [[nodiscard]] bool next(Operation& operation) override;

  // Bytes of the program read so far in its main line, for progress.
  std::uint64_t offset() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace passo
