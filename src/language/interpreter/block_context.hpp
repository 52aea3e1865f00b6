// BlockContext: the block that is executed, and all that its codes use. BlockExecutor fills it for each block; the
// families of codes (code_family.hpp) read and write it.
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
               const MachineAnswers& machine_answers)
      : state(machine),
        parameters(values),
        operations(queue),
        reporter(findings),
        answers(machine_answers),
        cutter(queue) {}

  ProgramState& state;
  Parameters& parameters;
  OperationQueue& operations;
  Reporter& reporter;
  const MachineAnswers& answers;
  CutterCompensation cutter;
  InterpreterOptions options;

  BlockWords words;
  const CodeEntry* motion = nullptr;  // what the block does with its axis words, if a motion does
  OperationSource source;
  WordPlace word;  // the word that is executed now; see Operation::word
  AxisWords axis_words;

  bool missing_feed_told = false;  // reported since the last F
  bool ended = false;              // the program has ended, and no block follows
  bool gave_up = false;            // it ended by (ABORT,…)
};

}  // namespace passo
