#include "passo/job/job_entry.hpp"

#include <utility>

namespace passo {
namespace {

// A probe move behind the place is made again.
std::vector<ProbeOutcome> before(const ResumePoint& point, std::vector<ProbeOutcome> probes) {
  if (probes.size() > point.probes) probes.resize(point.probes);
  return probes;
}

}  // namespace

JobEntry entry_at_rest(const JournalHead& head, const ResumePoint& point, const BoardStatus& status,
                       const MachineDescription& machine) {
  const Point stands = place_by_counts(head, point, status, machine);
  return {
      .at = point, .lead_in = way_back_of_probe(point, stands), .stands = stands, .probes = before(point, head.probes)};
}

JobEntry entry_by_way(const Reentry& way, std::vector<ProbeOutcome> probes) {
  return {.at = way.at, .lead_in = way.lead_in, .stands = {}, .probes = before(way.at, std::move(probes))};
}

void enter(request::Start& start, JobEntry entry) {
  start.from = std::move(entry.at);
  start.lead_in = std::move(entry.lead_in);
  start.stands = entry.stands;
  start.known_probes = std::move(entry.probes);
}

}  // namespace passo
