#include "passo/activity/program_stages.hpp"

#include "passo/activity/stage_options.hpp"

namespace passo {

ProgramStages::ProgramStages(ProgramReader program, const MachineDescription& machine,
                             const InterpreterOptions& options, const MachineResults& answers, Diagnostics& diagnostics,
                             std::vector<ProbeOutcome> known)
    : path_options_(path_options(machine, program.name(), options.start)),
      answers_(answers, std::move(known)),
      interpreter_(std::move(program), on_machine(machine, options), diagnostics, answers_),
      operations_(interpreter_),
      path_builder_(operations_, path_options_, diagnostics, answers_),
      path_until_error_(path_builder_, diagnostics),
      path_(path_until_error_),
      smoother_(path_, smoothness(machine), smoothing_share(machine)) {
  path_.watch([this](const PathItem& item) { answers_.see(item); });
}

}  // namespace passo
