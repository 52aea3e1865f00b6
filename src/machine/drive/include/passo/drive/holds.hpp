// HoldReasons: the set of reasons for a stop on the path. A hold ends when the set is empty.
//
// This set is the only record of a hold. The drive applies the set to the planner. The planner emits an action of kind
// feed_hold when the motion has stopped. The drive reads the reasons from the set, and never derives them from the
// action.
#pragma once

#include <cstdint>
#include <initializer_list>

namespace passo {

enum class HoldReason : std::uint8_t {
  operator_hold,  // the operator pressed hold
  door,           // the door is open, or was open and the operator has not pressed start since
  program_stop,   // the program waits for the operator: M0, M1
  tool_change,    // the program waits for another tool: M6
  await_line,     // the next line of the program has not arrived yet
  line_end,       // single block: the motion of a line has ended
  zero_feed,      // the overrides reduce the feed below a hundredth
  probe_contact,  // the probe move has made contact; the remaining move is dropped
  tap,            // the spindle reverses at the end of a tap
  drop,           // the planned path is dropped, up to the point at which the program waits for a line
  line_lost,      // the board executes its stop ramp, because no queue update reached it in time
  stop,           // the activity must end here
};
inline constexpr int hold_reason_count = 12;

class HoldReasons {
 public:
  constexpr HoldReasons() = default;
  constexpr HoldReasons(std::initializer_list<HoldReason> reasons) {
    for (const HoldReason reason : reasons) add(reason);
  }

  constexpr bool has(HoldReason reason) const { return (bits_ & bit(reason)) != 0; }
  constexpr bool any() const { return bits_ != 0; }
  constexpr bool any_of(HoldReasons others) const { return (bits_ & others.bits_) != 0; }
  constexpr void add(HoldReason reason) { bits_ = static_cast<std::uint16_t>(bits_ | bit(reason)); }
  constexpr void remove(HoldReason reason) { bits_ = static_cast<std::uint16_t>(bits_ & ~bit(reason)); }
  constexpr void set(HoldReason reason, bool holds) { holds ? add(reason) : remove(reason); }
  friend constexpr bool operator==(const HoldReasons&, const HoldReasons&) = default;

 private:
  static constexpr unsigned bit(HoldReason reason) { return 1U << static_cast<unsigned>(reason); }
  std::uint16_t bits_ = 0;
};

// The planner decelerates for `heeded_holds` only where the program enables holds (M53), and for `sure_holds`
// everywhere.
inline constexpr HoldReasons heeded_holds{HoldReason::operator_hold, HoldReason::door, HoldReason::line_end};
inline constexpr HoldReasons sure_holds{HoldReason::probe_contact, HoldReason::tap, HoldReason::drop, HoldReason::stop};
// Reasons that keep a stopped machine stopped. The other reasons end at the stop.
inline constexpr HoldReasons lasting_holds{HoldReason::operator_hold, HoldReason::door,       HoldReason::program_stop,
                                           HoldReason::tool_change,   HoldReason::await_line, HoldReason::line_end,
                                           HoldReason::zero_feed,     HoldReason::stop};

}  // namespace passo
