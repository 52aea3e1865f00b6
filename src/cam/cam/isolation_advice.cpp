#include "passo/cam/isolation_advice.hpp"

#include <algorithm>

namespace passo {
namespace {

constexpr Nanometres room_of_cut{6'000};  // that a cutter needs beyond its width, on both sides together

struct IsolationTrial {
  std::size_t cutter;
  Nanometres loss;
  Nanometres least_trace;
};

// The allowed loss with which a cutter fits into a gap, in steps of 5 um.
Nanometres loss_for(Nanometres gap, Nanometres width) {
  constexpr std::int64_t step = 5'000;
  const std::int64_t least = (width.count + room_of_cut.count - gap.count + 1) / 2;
  return {std::max<std::int64_t>(0, (least + step - 1) / step * step)};
}

// What could suffice for the narrowest gap: a finer cutter first, then a larger loss.
std::vector<IsolationTrial> trials_for(Nanometres gap, const std::vector<IsolationCutter>& finer,
                                       const IsolationOptions& now, Nanometres most_loss) {
  constexpr std::size_t most_trials = 4;
  constexpr Nanometres thin_trace{75'000};
  const Nanometres loss = now.allowed_loss;
  std::vector<IsolationTrial> trials;
  for (const Nanometres allowed : {loss, most_loss}) {
    for (std::size_t i = 0; i < finer.size() && trials.size() < most_trials; ++i) {
      const Nanometres needed = loss_for(gap, finer[i].width);
      if (needed > allowed) continue;
      const Nanometres used = std::max(needed, loss);
      const bool is_known = std::ranges::any_of(
          trials, [&](const IsolationTrial& trial) { return trial.cutter == i && trial.loss == used; });
      if (!is_known) trials.push_back({i, used, now.least_trace});
    }
    if (most_loss <= loss) break;
  }
  // A gap that is narrower than that stays; others may come apart.
  if (finer.empty()) return trials;
  if (trials.empty()) trials.push_back({finer.size() - 1, most_loss, now.least_trace});
  if (now.least_trace > thin_trace && most_loss.count > 0) trials.push_back({finer.size() - 1, most_loss, thin_trace});
  return trials;
}

}  // namespace

std::optional<IsolationAdvice> advise_isolation(const Region& copper, const std::vector<NetPlace>& known,
                                                const IsolationOptions& now, const JoinedNets& joined,
                                                const std::vector<IsolationCutter>& finer, Nanometres most_loss) {
  if (joined.gaps.empty()) return std::nullopt;
  std::optional<IsolationAdvice> best;
  for (const IsolationTrial& trial :
       trials_for(joined.gaps.front().width, finer, now, std::max(most_loss, now.allowed_loss))) {
    IsolationOptions options = now;
    *std::ranges::min_element(options.cutters, {}, &IsolationCutter::width) = finer[trial.cutter];
    options.allowed_loss = trial.loss;
    options.least_trace = trial.least_trace;
    Diagnostics none;
    const IsolationPlan plan = plan_isolation(copper, options, none);
    if (none.any_error()) return best;
    const IsolationProof proof = prove_isolation(copper, plan.mill, options.board, {}, plan.kept);
    if (proof.damage_mm2 > 0 || !proof.broken.empty()) continue;
    const JoinedNets left = find_joined_nets(copper, known, plan.mill, proof, finer[trial.cutter].width);
    if (left.joined < (best ? best->joined : joined.joined))
      best = IsolationAdvice{trial.cutter, trial.loss, trial.least_trace, left.joined, proof.lost_mm2, proof.deepest};
    if (left.joined == 0) break;
  }
  return best;
}

}  // namespace passo
