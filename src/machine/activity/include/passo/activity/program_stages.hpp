// ProgramStages: the chain of stages from a program's text to its smooth path.
//
//   text -> Interpreter -> PathBuilder -> PathUntilError -> PathSmoother
//
// A run uses this chain, and so does each query about its path: where a line begins, which state is set up at a
// position, how far a part of the path reaches. With other stages, the path items would have different numbers.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "passo/activity/path_until_error.hpp"
#include "passo/base/tap.hpp"
#include "passo/diagnostics/diagnostic.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/interpreter/interpreter.hpp"
#include "passo/interpreter/machine_results.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/path/path_builder.hpp"
#include "passo/path/path_smoother.hpp"

namespace passo {

// The machine results for a program that is interpreted again: first the known results of its probe moves, in order,
// then those of the machine.
class KnownProbes final : public MachineResults {
 public:
  // `machine` must outlive this object.
  KnownProbes(const MachineResults& machine, std::vector<ProbeOutcome> known)
      : machine_(machine), known_(std::move(known)) {}

  const ProbeOutcome* probe() const override { return knows_last() ? &known_[begun_ - 1] : machine_.probe(); }
  const Point* tap_reversal() const override { return machine_.tap_reversal(); }

  // Processes each path item before the stages continue.
  void see(const PathItem& item) {
    const auto* action = std::get_if<Action>(&item);
    if (action != nullptr && action->kind == Action::Kind::probe_begin) ++begun_;
  }
  // Whether the outcome of the newest probe move is known.
  bool knows_last() const { return begun_ > 0 && begun_ <= known_.size(); }

 private:
  const MachineResults& machine_;
  std::vector<ProbeOutcome> known_;
  std::size_t begun_ = 0;  // number of probe moves begun
};

class ProgramStages {
 public:
  // `answers` and `diagnostics` must outlive the stages. `known`: the earlier results of the first probe moves.
  ProgramStages(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                const MachineResults& answers, Diagnostics& diagnostics, std::vector<ProbeOutcome> known = {});

  // Taps for observers of the operations and of the programmed path. Add observers before the first item.
  Tap<Operation>& operations() { return operations_; }
  Tap<PathItem>& path() { return path_; }
  // The output of the chain.
  Source<PathItem>& smooth_path() { return smoother_; }

  const Interpreter& interpreter() const { return interpreter_; }
  const PathBuilder& path_builder() const { return path_builder_; }
  const KnownProbes& answers() const { return answers_; }

 private:
  PathOptions path_options_;
  KnownProbes answers_;
  Interpreter interpreter_;  // text -> blocks -> operations
  Tap<Operation> operations_;
  PathBuilder path_builder_;         // operations -> segments
  PathUntilError path_until_error_;  // passes items until there is an error
  Tap<PathItem> path_;
  PathSmoother smoother_;  // corners -> curves within the tolerance
};

}  // namespace passo
