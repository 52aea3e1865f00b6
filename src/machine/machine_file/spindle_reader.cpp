#include "spindle_reader.hpp"

namespace passo {
namespace {

constexpr NumberKey counts_key{"encoder_counts_per_turn", 4, 1e6, "4096"};
constexpr NumberKey run_up_key{"run_up_s", 0, 1000, "0.5"};
constexpr NumberKey droop_key{"droop_percent", 0, 50, "3"};
constexpr NumberKey ripple_key{"ripple_percent", 0, 50, "5"};
constexpr NumberKey ripple_rate_key{"ripple_hz", 0.01, 1000, "2"};

}  // namespace

SpindleDescription read_spindle(TableReader& reader) {
  SpindleDescription spindle;
  if (const auto counts = reader.whole_number(counts_key, Need::optional)) {
    spindle.counts_per_turn = static_cast<int>(*counts);
  }
  if (const auto time = reader.number(run_up_key, Need::optional)) spindle.run_up = Seconds(*time);
  spindle.run_up_is_given = reader.has(run_up_key.name);
  if (const auto droop = reader.number(droop_key, Need::optional)) spindle.droop = *droop / 100;
  if (const auto ripple = reader.number(ripple_key, Need::optional)) spindle.ripple = *ripple / 100;
  if (const auto rate = reader.number(ripple_rate_key, Need::optional)) spindle.ripple_rate = Hertz(*rate);
  return spindle;
}

}  // namespace passo
