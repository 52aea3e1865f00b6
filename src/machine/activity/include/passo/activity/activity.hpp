// Activity: something that a machine can be busy with: a program, a jog, homing, or a probe move. An activity is a
// path, and what the path needs of the machine.
//
// An activity is a plain source of path items. An activity knows nothing of boards and waits for nothing. What the
// machine finds on the way reaches the activity through MachineAnswers. No stage reads past a question before the
// answer is there.
#pragma once

#include <cstdint>
#include <optional>

#include "passo/activity/machine_fault.hpp"
#include "passo/base/source.hpp"
#include "passo/path/segment.hpp"

namespace passo {

enum class ActivityKind : std::uint8_t { program, jog, homing, probing };

class Activity : public Source<PathItem> {
 public:
  virtual ActivityKind kind() const = 0;
  // Which part of the whole path has been planned so far, 0 to 1. Empty: unknown.
  virtual std::optional<double> progress() const { return {}; }
  // Why the activity failed, if it did. Valid after the last item was played.
  virtual std::optional<ActivityFault> fault() const { return {}; }
};

}  // namespace passo
