#include "passo/job/stored_position.hpp"

#include <utility>

#include <unistd.h>

#include "passo/job/state_file.hpp"

namespace passo {

StoredPosition::StoredPosition(std::string path) : path_(std::move(path)) {
  const auto text = path_.empty() ? std::nullopt : read_state_file(path_);
  if (text) record_ = read_place_record(*text);
}

KnownPosition StoredPosition::counted(const MachineDescription& machine, const BoardStatus& status) const {
  if (const auto known = place(machine, status)) return *known;
  const auto by_counts = counted_place(record_, machine, status);
  const bool counts_on = by_counts && !record_->is_lost && (status.state & board_trusted) != 0;
  return {.place = by_counts.value_or(Point()), .trust = Trust::unknown, .is_lost = record_.has_value() && !counts_on};
}

bool StoredPosition::keep(const MachineDescription& machine, const KnownPosition& position,
                          const MotorSteps& zero_counts, const SessionNumbers& numbers) {
  PositionRecord record{.machine = place_fingerprint(machine),
                        .trust = position.trust,
                        .zero_counts = {},
                        .numbers = numbers,
                        .is_lost = position.is_lost};
  for (std::size_t m = 0; m < machine.axes.size(); ++m) record.zero_counts.push_back(static_cast<int>(zero_counts[m]));
  if (record_ == record) return true;
  record_ = std::move(record);
  if (path_.empty()) return true;
  const int descriptor = replace_state_file(path_, text_of(*record_));
  if (descriptor >= 0) close(descriptor);
  return descriptor >= 0;
}

}  // namespace passo
