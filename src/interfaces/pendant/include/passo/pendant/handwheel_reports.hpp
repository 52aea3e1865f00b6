// HandwheelReports: what a board tells of the handwheel at its pins, as the reports of a pendant.
//
// Position in the pipeline: BoardSession -> HandwheelReports -> PendantControl. handwheel_table() describes the
// reports: the detents since the last one, the selected axis, the selected step.
//
// Invariant: a detent counts when all of its edges have come, so a wheel that trembles between two detents moves
// nothing. Edges while the selectors change move nothing either, and so do the edges before the first reading.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "passo/machine_file/handwheel_description.hpp"
#include "passo/pendant/pendant_table.hpp"
#include "passo/wire/handwheel_count.hpp"

namespace passo {

PendantTable handwheel_table(const HandwheelDescription& wheel);

class HandwheelReports {
 public:
  // More edges than this between two readings, a turn in a few milliseconds, are a damaged message.
  static constexpr std::int32_t most_edges = 1000;

  explicit HandwheelReports(const HandwheelDescription& wheel) : counts_per_detent_(wheel.counts_per_detent) {}

  std::vector<std::uint8_t> next(const HandwheelCount& reading);
  // The next reading is the first one again.
  void forget() { last_.reset(); }

 private:
  int take_detents(const HandwheelCount& reading, bool counts);

  int counts_per_detent_;
  std::optional<HandwheelCount> last_;
  std::uint32_t detent_at_ = 0;  // the count at the last detent
};

}  // namespace passo
