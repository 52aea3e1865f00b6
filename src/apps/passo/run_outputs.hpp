// RunOutputs: the files that a run was asked for. Opened before it, filled while it goes, given their names after it.
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

// Whether a name tells what kind of file is wanted.
bool is_picture_name(const std::string& path);
bool is_trace_name(const std::string& path);

class RunOutputs {
 public:
  // `parameters`, `tools`: the files that they go to after the run; empty: none. Fails when a file cannot be written.
  static Result<RunOutputs, OutputError> open(const RunArguments& arguments, const MachineDescription& machine,
                                              const std::string& parameters, const std::string& tools);

  RunOutputs(RunOutputs&&) noexcept;
  RunOutputs& operator=(RunOutputs&&) noexcept;
  ~RunOutputs();

  // Before the first step of the program. `machine` does what the board does.
  void watch(VirtualMachine& machine, Watchers& watchers);
  // A file cannot take more: there is no point in going on.
  bool failed() const;
  // After the program has come to its end.
  Status<OutputError> commit(const RunSummary& summary, const SavedParameters& parameters, const ToolTable& tools,
                             LengthUnits machine_units);

 private:
  struct State;
  explicit RunOutputs(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace passo
