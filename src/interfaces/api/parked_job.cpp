#include "parked_job.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "passo/interpreter/saved_offsets.hpp"
#include "passo/journal/stop_place.hpp"

namespace passo {
namespace {

bool is_changed(const SavedParameters& before, const SavedParameters& now, int system) {
  const auto differs = [&](int number) { return saved_value(before, number) != saved_value(now, number); };
  const int first = work_offset_parameter(system);
  return saved_point(before, first) != saved_point(now, first) || differs(rotation_parameter(system));
}

}  // namespace

Result<Reentry, Sentence> ParkedJob::way_behind_stop(const MachineDescription& machine, const ProgramStore& programs,
                                                     const Point& stands) const {
  const auto refused = [](std::string_view code, std::string_view why, SentenceArguments arguments = {}) {
    return Failure{Sentence{std::string(code), std::move(arguments), std::string(why)}};
  };
  const auto refused_for = [&](ReentryRefusal refusal) { return refused(code_of(refusal), message_of(refusal)); };
  const StoredProgram* const program = programs.find(job.program);
  if (program == nullptr) return refused_for(ReentryRefusal::path_changed);
  InterpreterOptions options = programs.options_of(*program);
  options.start = start;
  const auto stop =
      find_stop(ProgramReader::from_text(program->name, program->text), machine, options, wait.number, probes);
  if (!stop) return refused_for(ReentryRefusal::bad_program);
  if (stop->line != wait.line) return refused_for(ReentryRefusal::path_changed);
  std::vector<int> changed;
  for (int system = 1; system <= work_systems; ++system) {
    if (is_changed(parameters, programs.parameters(), system)) changed.push_back(system);
  }
  const bool any_changed = !changed.empty() || tools != programs.tools();
  if (any_changed && stop->sets_own_zero) {
    return refused("waits.own-zero",
                   "the program itself has set a zero or a tool before this stop, which overrides yours: stop it, and "
                   "start at a line");
  }
  if (!changed.empty() && std::ranges::find(changed, int{stop->system}) == changed.end()) {
    return refused("waits.other-zero",
                   fmt::format("the program uses {}, but another zero was set: set that one, or restore the other",
                               name_of_system(stop->system)),
                   {{"system", std::string(name_of_system(stop->system))}});
  }
  auto way = plan_reentry(machine, stop->at, stands);
  if (!way) return refused_for(way.error());
  return std::move(*way);
}

}  // namespace passo
