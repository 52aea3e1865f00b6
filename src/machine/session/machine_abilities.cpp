#include "passo/session/machine_abilities.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace passo {
namespace {

constexpr std::array<std::string_view, ability_count> ability_names = {
    "exact-resume", "step-counts",  "pulses", "adaptive-feed", "any-override", "single-block",
    "door-hold",    "probe-state",  "jog",    "home",          "home-axis",    "probe",
    "sleep",        "set-position", "thread", "board-files"};

}  // namespace

std::string_view name_of(Ability ability) {
  return ability_names[static_cast<std::size_t>(ability)];
}

void MachineAbilities::lack(Ability ability, Sentence why) {
  if (can(ability)) lacking_.push_back({.ability = ability, .why = std::move(why)});
}

const Sentence* MachineAbilities::why_not(Ability ability) const {
  const auto found = std::ranges::find(lacking_, ability, &Lack::ability);
  return found != lacking_.end() ? &found->why : nullptr;
}

}  // namespace passo
