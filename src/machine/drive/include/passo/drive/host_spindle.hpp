// HostSpindle: a spindle that this computer controls itself, over a bus of its own, beside the board.
//
// The owner of the machine orders what the board has switched (BoardOutputs), as soon as it knows. The spindle reports
// whether it has reached its speed: motion waits for that (Action::Kind::await_speed).
//
// Invariants: no function waits for the bus. After a fault the spindle is off, whatever is ordered, until
// clear_fault().
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "passo/base/sentence.hpp"
#include "passo/path/segment.hpp"
#include "passo/wire/board_segment.hpp"

namespace passo {

struct SpindleOrder {
  SpindleDirection direction = SpindleDirection::off;
  double revolutions_per_minute = 0;  // 0 if the spindle is off

  static SpindleOrder of(const BoardOutputs& outputs) {
    if ((outputs.switches & OutputSwitch::spindle_on) == 0) return {};
    const bool reverse = (outputs.switches & OutputSwitch::spindle_reverse) != 0;
    return {.direction = reverse ? SpindleDirection::counterclockwise : SpindleDirection::clockwise,
            .revolutions_per_minute = static_cast<double>(outputs.spindle_rpm)};
  }
  bool turns() const { return direction != SpindleDirection::off; }
  friend bool operator==(const SpindleOrder&, const SpindleOrder&) = default;
};

struct HostSpindleStatus {
  SpindleOrder order;                  // as last ordered
  bool answers = false;                // the drive has answered lately
  bool at_speed = false;               // the ordered speed is reached
  double revolutions_per_minute = 0;   // as the drive reports it
  std::optional<double> current = {};  // A
  std::optional<double> load = {};     // as a fraction of the rated load
  Sentence fault = {};                 // without a code: none
  std::uint64_t version = 0;           // grows with each change

  bool has_failed() const { return !fault.code.empty(); }
};

class HostSpindle {
 public:
  virtual ~HostSpindle() = default;
  HostSpindle(const HostSpindle&) = delete;
  HostSpindle& operator=(const HostSpindle&) = delete;

  virtual void order(const SpindleOrder& wanted) = 0;
  virtual HostSpindleStatus status() const = 0;

  // Before motion begins or continues. Returns whether the spindle can be used: the drive answers, and has no fault any
  // more.
  bool clear_fault() {
    if (!try_to_clear()) return false;
    fault_is_told_ = false;
    return true;
  }
  // Returns true once for each fault.
  bool take_new_fault() {
    const bool has_failed = status().has_failed();
    return has_failed && !std::exchange(fault_is_told_, has_failed);
  }

 protected:
  HostSpindle() = default;

 private:
  virtual bool try_to_clear() = 0;

  bool fault_is_told_ = false;
};

}  // namespace passo
