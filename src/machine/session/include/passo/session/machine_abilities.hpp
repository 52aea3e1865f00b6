// MachineAbilities: what a machine cannot do, each with the reason as a sentence. What is not listed, it can do.
//
// A machine on a board of ours has all abilities but two: it homes all axes together, and stores no files. A board that
// plans its own motion lacks some, and clients show the reason where the ability would be used.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "passo/base/sentence.hpp"

namespace passo {

enum class Ability : std::uint8_t {
  exact_resume,   // an interrupted job continues exactly where the machine has stopped
  step_counts,    // the position is compared with the board's counts
  pulses,         // the step pulses can be shown
  adaptive_feed,  // the machine's own feed factor
  any_override,   // feed, rapid and spindle factors of any value; otherwise in the board's steps
  single_block,   // a program holds after each line
  door_hold,      // a hold that switches spindle and coolant off
  probe_state,    // the state of the probe is known at rest
  jog,
  home,
  home_axis,  // a single axis is homed
  probe,
  sleep,
  set_position,  // the operator states where the machine is
  thread,        // motion that follows the spindle
  board_files,   // the board stores files, and runs them by itself
};
inline constexpr std::size_t ability_count = 16;

// Stable, e.g. "exact-resume".
std::string_view name_of(Ability ability);

class MachineAbilities {
 public:
  struct Lack {
    Ability ability;
    Sentence why;
  };

  // Adds an ability that the machine does not have. The first reason counts.
  void lack(Ability ability, Sentence why);
  // Returns why the machine cannot do it, or null if it can.
  const Sentence* why_not(Ability ability) const;
  bool can(Ability ability) const { return why_not(ability) == nullptr; }
  const std::vector<Lack>& lacking() const { return lacking_; }

 private:
  std::vector<Lack> lacking_;
};

}  // namespace passo
