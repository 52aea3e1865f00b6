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

class BlockWatcher;

// Whose G-code: LinuxCNC's RS274/NGC, or the part of it that grbl 1.1 accepts, with grbl's numbers in the diagnostics.
enum class Dialect : std::uint8_t { linuxcnc, grbl };

struct InterpreterOptions {
  Dialect dialect = Dialect::linuxcnc;
  bool block_delete = false;            // lines that start with '/' are skipped
  LengthUnits units = LengthUnits::mm;  // before the program says G20 or G21
  Point start;                          // machine position at the start
  // Passes of a loop without any operation between, before it is stopped with a diagnostic.
  std::uint64_t idle_passes = 1'000'000;
};

class Interpreter final : public Source<Operation> {
 public:
  Interpreter(ProgramReader reader, const InterpreterOptions& options, Diagnostics& diagnostics);
  ~Interpreter() override;

  [[nodiscard]] bool next(Operation& operation) override;

  // What this module's explain() sees blocks with; borrowed.
  void watch(BlockWatcher& watcher);

  // Bytes of the program read so far in its main line, for progress.
  std::uint64_t offset() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace passo
