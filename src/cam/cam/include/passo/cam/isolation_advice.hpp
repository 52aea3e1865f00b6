// advise_isolation: finds a cutter, or an allowed loss, that separates all nets of a layer. Each proposal has been
// planned and proved.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "passo/cam/board_layer.hpp"
#include "passo/cam/isolation.hpp"
#include "passo/cam/joined_nets.hpp"

namespace passo {

struct IsolationAdvice {
  std::size_t cutter = 0;  // index into the cutters that were proposed
  Nanometres allowed_loss = {};
  Nanometres least_trace = {};
  std::size_t joined = 0;  // nets that stay joined with it
  double lost_mm2 = 0;
  Nanometres deepest = {};
};

// `now`: the options with which `joined` was found. `finer`: cutters to try in place of the finest one, from wide to
// narrow; the first may be the finest itself. `most_loss`: the largest allowed loss to try. At most five trials; the
// last one, where no other parts all nets, is with thinner traces. Returns the first trial in which all nets come
// apart; otherwise the trial that leaves the fewest nets joined, if they are fewer than now.
std::optional<IsolationAdvice> advise_isolation(const Region& copper, const std::vector<NetPlace>& known,
                                                const IsolationOptions& now, const JoinedNets& joined,
                                                const std::vector<IsolationCutter>& finer, Nanometres most_loss);

}  // namespace passo
