#include "passo/journal/cut_between.hpp"

#include <utility>

#include "path_of_program.hpp"
#include <fmt/format.h>

#include "passo/activity/nominal_time.hpp"

namespace passo {
namespace {

// The part of a segment between the positions; 0: it is outside.
double share_of(const Segment& segment, std::uint64_t number, const PathPosition& first, const PathPosition& last) {
  if (number < first.item || number > last.item) return 0;
  const double length = segment.curve.length().value();
  const double from = number == first.item ? first.s.value() : 0;
  const double to = number == last.item ? last.s.value() : length;
  return to > from ? (to - from) / length : 0;
}

}  // namespace

CutAmounts cut_between(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                       const PathPosition& first, const PathPosition& last, const std::vector<ProbeOutcome>& probes) {
  PathOfProgram chain(std::move(program), machine, options, probes);
  RewindablePath& path = chain.path();
  path.forget_passed();
  const MotionLimits limits = motion_limits(machine);
  CutMeter meter;
  PathItem item;
  for (std::uint64_t number = 0; number <= last.item && path.next(item); ++number) {
    const auto* const segment = std::get_if<Segment>(&item);
    const double share = segment != nullptr ? share_of(*segment, number, first, last) : 0;
    // An action at the last position is not done yet.
    if (share > 0 || (segment == nullptr && number < last.item)) {
      meter.watch(item, segment != nullptr ? nominal_time_of(item, limits) : Seconds(0), share);
    }
  }
  return meter.amounts();
}

std::string run_of(const JournalHead& head) {
  return fmt::format("{:016x}-{}-{}-{}-{}", head.path, head.numbers.session, head.numbers.executed_before,
                     head.place.item, head.place.s.value());
}

}  // namespace passo
