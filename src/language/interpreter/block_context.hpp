// BlockContext: the block being executed, and the data that its codes share. BlockExecutor fills it for each block; the
// code families (code_family.hpp) read and write it.
#pragma once

#include "block_words.hpp"
#include "cutter_compensation.hpp"
#include "operation_queue.hpp"
#include "parameters.hpp"
#include "program_state.hpp"
#include "reporter.hpp"

#include "passo/interpreter/interpreter.hpp"

namespace passo {

struct BlockContext {
  BlockContext(ProgramState& machine, Parameters& values, OperationQueue& queue, Reporter& findings,
               const MachineResults& machine_results)
      : state(machine),
        parameters(values),
        operations(queue),
        reporter(findings),
        answers(machine_results),
        cutter(queue) {}

  ProgramState& state;
  Parameters& parameters;
  OperationQueue& operations;
  Reporter& reporter;
  const MachineResults& answers;
  CutterCompensation cutter;
  InterpreterOptions options;

  BlockWords words;
  const CodeEntry* motion = nullptr;  // the motion code that uses the block's axis words, if there is one
  OperationSource source;
  WordPlace word;  // the word being executed; see Operation::word
  AxisWords axis_words;

  bool missing_feed_told = false;  // already reported since the last F
  bool ended = false;              // the program has ended; no block follows
  bool gave_up = false;            // it was ended by (ABORT,…)
};

}  // namespace passo
