#include "passo/journal/stop_place.hpp"

#include <cmath>

#include "path_of_program.hpp"

#include "passo/drive/program_stop.hpp"
#include "passo/interpreter/is_any_of.hpp"
#include "passo/interpreter/saved_offsets.hpp"

namespace passo {
namespace {

// Looks at the operations up to a stop.
class ZeroWatch {
 public:
  ZeroWatch(const SavedParameters& parameters, std::uint64_t number, StopPlace& stop)
      : parameters_(parameters), number_(number), stop_(stop) {}

  void watch(const Operation& operation) {
    if (seen_ == number_) return;
    if (is_any_of<operation::ProgramStop, operation::OptionalProgramStop, operation::ChangeTool>(operation)) ++seen_;
    if (const auto* const work = std::get_if<operation::SetWorkOffset>(&operation.what)) {
      stop_.system = work->system;
      note(work->offset, work_offset_parameter(work->system));
    }
    if (is_any_of<operation::SetToolTableEntry>(operation)) stop_.sets_own_zero = true;
    if (const auto* const g92 = std::get_if<operation::SetG92Offset>(&operation.what)) note(g92->offset, g92_parameter);
  }

 private:
  void note(const Point& offset, int first) {
    const Point saved = saved_point(parameters_, first);
    for (const Axis axis : all_axes) {
      constexpr double rounding = 1e-9;
      if (std::abs(offset[axis] - saved[axis]) > rounding) stop_.sets_own_zero = true;
    }
  }

  const SavedParameters& parameters_;
  std::uint64_t number_;
  StopPlace& stop_;
  std::uint64_t seen_ = 0;
};

}  // namespace

std::optional<StopPlace> find_stop(const ProgramReader& program, const MachineDescription& machine,
                                   const InterpreterOptions& options, std::uint64_t number,
                                   const std::vector<ProbeOutcome>& probes) {
  StopPlace stop;
  std::optional<PathPosition> behind;
  {
    PathOfProgram chain(program.again(), machine, options, probes);
    ZeroWatch zero(options.parameters, number, stop);
    chain.operations().watch([&](const Operation& operation) { zero.watch(operation); });
    RewindablePath& path = chain.path();
    path.forget_passed();
    PathItem item;
    std::uint64_t stops = 0;
    for (std::uint64_t next = 1; !behind && path.next(item); ++next) {
      const auto* const action = std::get_if<Action>(&item);
      if (action == nullptr || !is_program_stop(*action) || ++stops < number) continue;
      behind = PathPosition{.item = next};
      stop.line = action->source.line;
    }
    if (chain.any_error() || !behind) return {};
  }
  const auto point = find_resume_point(program.again(), machine, options, *behind, probes);
  if (!point) return {};
  stop.at = *point;
  return stop;
}

}  // namespace passo
