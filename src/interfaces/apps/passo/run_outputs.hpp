// RunOutputs: the files that a run was asked to write. They are opened before the run, filled during the run, and named
// after the run.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"

#include "passo/base/result.hpp"
#include "passo/machine/machine_observer.hpp"
#include "passo/machine/virtual_machine.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/report/output_file.hpp"
#include "passo/report/summary.hpp"
#include "passo/session/request.hpp"

namespace passo {

// Returns whether the name has the extension of a trace.
bool is_trace_name(const std::string& path);

class RunOutputs {
 public:
  // `parameters`, `tools`: the files for parameters and tools after the run; empty: none. Fails if a file cannot be
  // written.
  static Result<RunOutputs, OutputError> open(const RunArguments& arguments, const MachineDescription& machine,
                                              const std::string& parameters, const std::string& tools);

  RunOutputs(RunOutputs&&) noexcept;
  RunOutputs& operator=(RunOutputs&&) noexcept;
  ~RunOutputs();

  // Must be called before the first step of the program. `machine` is a virtual machine that mirrors the board.
  void watch(VirtualMachine& machine, Watchers& watchers);
  // Returns the file for the way of the motors; null: none was asked for.
  OutputFile* true_path();
  // Returns whether writing a file has failed, so that continuing is pointless.
  bool failed() const;
  // Must be called after the program has reached its end.
  Status<OutputError> commit(const RunSummary& summary, const SavedParameters& parameters, const ToolTable& tools,
                             LengthUnits machine_units);

 private:
  struct State;
  explicit RunOutputs(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace passo
