// Activity: a task of the machine: a program, a jog, homing or a probe move. It provides a path, and uses results of
// the machine that the path depends on.
//
// An activity is a source of path items. It is independent of boards and never waits. Results of the machine, e.g. of a
// probe move, reach it through MachineResults. No stage reads past a point that needs such a result until the result is
// available.
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
  // The fraction of the path planned so far, 0 to 1. Empty: unknown.
  virtual std::optional<double> progress() const { return {}; }
  // The fault of a failed activity. Valid after the last item was executed.
  virtual std::optional<ActivityFault> fault() const { return {}; }
};

}  // namespace passo
