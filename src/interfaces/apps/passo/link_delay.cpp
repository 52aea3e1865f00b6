#include "link_delay.hpp"

#include "program_input.hpp"
#include "progress_display.hpp"

namespace passo {

std::optional<LinkDelay> line_cost_with_progress(const ProgramReader& program, const MachineDescription& machine,
                                                 const InterpreterOptions& options, const ProgramCheck& check,
                                                 Seconds without) {
  if (!has_line_cost(machine, check)) return {};
  ProgressDisplay progress(program.name());
  const auto cost = link_delay(program.again(), machine, options, check, without,
                               [&progress](double share) { progress.update(share); });
  if (cost) return *cost;
  progress.clear();
  if (!cost.error().empty()) fail(exit_failed, "the board: " + cost.error());
  return {};
}

}  // namespace passo
