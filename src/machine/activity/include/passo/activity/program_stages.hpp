// ProgramStages: a program from its text to a smooth path, as one chain of stages.
//
//   text -> Interpreter -> PathBuilder -> GoodPath -> PathSmoother
//
// A run goes through this chain, and so does each question about the path of a run: where a line begins, what was set
// up to a place, how far a part of it reaches. Through other stages the items of the path would have other numbers.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "passo/activity/good_path.hpp"
#include "passo/base/tap.hpp"
#include "passo/diagnostics/diagnostic.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/interpreter/interpreter.hpp"
#include "passo/interpreter/machine_answers.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/path/path_builder.hpp"
#include "passo/path/path_smoother.hpp"

namespace passo {

// The answers to a program that is gone through again: first what its probe moves have found before, in their order,
// then what the machine answers.
class KnownProbes final : public MachineAnswers {
 public:
  // `machine` outlives this.
  KnownProbes(const MachineAnswers& machine, std::vector<ProbeOutcome> known)
      : machine_(machine), known_(std::move(known)) {}

  const ProbeOutcome* probe() const override { return knows_last() ? &known_[begun_ - 1] : machine_.probe(); }
  const Point* tap_rest() const override { return machine_.tap_rest(); }

  // Sees each item of the path before the stages go on.
  void see(const PathItem& item) {
    const auto* action = std::get_if<Action>(&item);
    if (action != nullptr && action->kind == Action::Kind::probe_begin) ++begun_;
  }
  // The outcome of the probe move that began last is known.
  bool knows_last() const { return begun_ > 0 && begun_ <= known_.size(); }

 private:
  const MachineAnswers& machine_;
  std::vector<ProbeOutcome> known_;
  std::size_t begun_ = 0;  // probe moves
};

class ProgramStages {
 public:
  // `answers` and `diagnostics` outlive the stages. `known`: what the first probe moves have found before.
  ProgramStages(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                const MachineAnswers& answers, Diagnostics& diagnostics, std::vector<ProbeOutcome> known = {});

  // For watchers of the operations, and of the path as the program means it. Watchers are added before the first item.
  Tap<Operation>& operations() { return operations_; }
  Tap<PathItem>& path() { return path_; }
  // What comes out of the chain.
  Source<PathItem>& smooth_path() { return smoother_; }

  const Interpreter& interpreter() const { return interpreter_; }
  const PathBuilder& path_builder() const { return path_builder_; }
  const KnownProbes& answers() const { return answers_; }

 private:
  PathOptions path_options_;
  KnownProbes answers_;
  Interpreter interpreter_;  // text -> blocks -> operations
  Tap<Operation> operations_;
  PathBuilder path_builder_;  // operations -> segments
  GoodPath good_path_;        // as long as there is no error
  Tap<PathItem> path_;
  PathSmoother smoother_;  // corners -> curves within the tolerance
};

}  // namespace passo
