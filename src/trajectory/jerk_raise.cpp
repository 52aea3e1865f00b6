// JerkProfile: raises the decided part to nearly the fastest motion (JerkLift). Its phases are checked like any plan's.
//
// A cell that exceeds a limit is raised again with a smaller share of the limits, together with the cells around it.
// Cells that still exceed one after some rounds are played as planned. Nodes stay as they are where nothing can be
// gained: beside rests, where the bend jumps, at the highest possible speed. Both ends of the raised part stay too, so
// that the plan after it remains valid.
#include <algorithm>
#include <cmath>
#include <limits>

#include "jerk_profile.hpp"

namespace passo {
namespace {

// Shares of the limits up to which motion is raised. In bends, demands are larger between the places that JerkLift
// looks at.
constexpr double share_in_bends = 0.985;
constexpr double share_of_straights = 0.998;
constexpr double least_lowering = 0.995;
constexpr double most_lowering = 0.7;
constexpr double safely = 0.998;
constexpr double lower_cap = 0.9995;

constexpr double at_cap = 1 - 1e-6;
constexpr int rounds_of_raising = 7;
constexpr int rounds_nearby = 3;
constexpr std::size_t nearby = 14;  // cells on both sides of one that are raised again with it
constexpr std::size_t fewest_to_raise = 5;

}  // namespace

// Caps by feed, velocity and jumps of the bend: no acceleration changes them.
void JerkProfile::find_passing_caps() {
  const std::size_t n = cells_.size();
  passing_cap_.assign(n + 1, std::numeric_limits<double>::infinity());
  jumps_.assign(n + 1, false);
  for (std::size_t k = 0; k <= n; ++k) {
    double& cap = passing_cap_[k];
    if (k > 0) cap = cells_[k - 1].top_squared;
    if (k < n) cap = std::min(cap, cells_[k].top_squared);
    cap *= planned_velocity * planned_velocity;
    if (k == 0 || k == n || (cells_[k - 1].straight && cells_[k].straight)) continue;
    for (std::size_t a = 0; a < axes_.size(); ++a) {
      const double jump = std::abs(shapes(k)[a].bend_in - shapes(k - 1)[a].bend_out);
      if (jump * cap <= unseen_jump * axes_[a].acceleration) continue;
      cap = unseen_jump * axes_[a].acceleration / jump;
      jumps_[k] = true;
    }
  }
}

void JerkProfile::find_fixed(std::size_t last) {
  const std::size_t n = cells_.size();
  fixed_.assign(n + 1, false);
  const auto fix = [this](std::size_t from, std::size_t to) {
    for (std::size_t k = from; k <= std::min(to, fixed_.size() - 1); ++k) fixed_[k] = true;
  };
  const auto is_at_cap = [this](std::size_t k) { return x_[k] >= passing_cap_[k] * at_cap; };
  fix(0, 1);
  fix(last < n ? last - 2 : last - 1, n);
  for (std::size_t k = 1; k < last; ++k) {
    if (x_[k] <= 0 || jumps_[k]) fix(k - 1, k + 1);
    if (is_at_cap(k - 1) && is_at_cap(k) && is_at_cap(k + 1)) fix(k, k);
  }
}

// Raises the planned motion up to that node.
void JerkProfile::raise(std::size_t last) {
  if (last < fewest_to_raise) return;
  find_fixed(last);
  const std::size_t n = cells_.size();
  states_.clear();
  for (std::size_t k = 0; k <= n; ++k) states_.push_back(planned_state(k));
  is_raised_ = true;
  unraised_.assign(states_.begin(), states_.end());
  lift_share_.clear();
  lift_cap_.clear();
  for (const JerkCell& cell : cells_) {
    lift_share_.push_back(cell.straight ? share_of_straights : share_in_bends);
    lift_cap_.push_back(cell.top_squared * planned_velocity * planned_velocity);
  }
  for (std::size_t k = 2; k < last; ++k) {
    if (fixed_[k]) continue;
    const std::size_t first = k - 1;
    while (!fixed_[k]) ++k;
    raise_between(first, k);
  }
}

// Raises all nodes between two fixed ones.
void JerkProfile::raise_between(std::size_t first, std::size_t last) {
  const JerkLift::Stretch stretch{.cells = cells_, .shapes = shapes_, .share = lift_share_, .cap = lift_cap_};
  if (!lift_.raise(stretch, first, last, states_)) return;
  again_.assign(1, {first, last});
  for (int round = 0; round <= rounds_of_raising; ++round) {
    exceeded_.clear();
    for (const Stretch& raised : again_) find_raised_too_far(raised);
    if (exceeded_.empty()) return;
    if (round == rounds_of_raising) break;
    if (round == rounds_nearby) {  // begin anew, with the limits as known now
      put_back(first, last);
      if (!lift_.raise(stretch, first, last, states_)) return;
      again_.assign(1, {first, last});
      continue;
    }
    again_.clear();
    const std::size_t beside = round < rounds_nearby ? nearby : 3 * nearby;
    for (std::size_t k = 0; k < exceeded_.size();) {
      Stretch around{.first = std::max(exceeded_[k], first + beside) - beside, .last = exceeded_[k]};
      while (k < exceeded_.size() && exceeded_[k] <= around.last + beside) around.last = exceeded_[k++];
      around.last = std::min(around.last + 1 + beside, last);
      again_.push_back(around);
      // If no solution is found, the next round finds the excess again and raises more cells with it.
      static_cast<void>(lift_.raise(stretch, around.first, around.last, states_));
    }
  }
  put_back(first, last);
}

// Restores the planned motion.
void JerkProfile::put_back(std::size_t first, std::size_t last) {
  const auto at = [](std::vector<State>& states, std::size_t k) {
    return states.begin() + static_cast<std::ptrdiff_t>(k);
  };
  std::copy(at(unraised_, first), at(unraised_, last + 1), at(states_, first));
}

void JerkProfile::find_raised_too_far(const Stretch& raised) {
  for (std::size_t i = raised.first; i < raised.last; ++i) {
    const Excess worst = excess(i);
    const double most = std::max(worst.force, worst.jolt);
    if (most <= 1) continue;
    exceeded_.push_back(i);
    lift_share_[i] *= std::clamp(safely / most, most_lowering, least_lowering);
    if (worst.force > 1) lift_cap_[i] *= lower_cap;  // the speed may be the reason
  }
}

}  // namespace passo
