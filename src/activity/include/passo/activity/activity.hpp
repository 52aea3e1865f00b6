// Activity: what a machine can be busy with: a path, and what the path needs of the machine. A program, a jog, homing,
// a probe move.
//
// An activity is a plain source of path items. It knows nothing of boards and waits for nothing: what the machine finds
// on the way reaches it through MachineAnswers, and no stage reads past a question before the answer is there.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "passo/base/source.hpp"
#include "passo/path/segment.hpp"

namespace passo {

enum class ActivityKind : std::uint8_t { program, jog, homing, probing };

// Why an activity did not do what it was to do. `code` is stable; the message is a sentence without a full stop.
struct ActivityFault {
  std::string code;
  std::string message;
};

class Activity : public Source<PathItem> {
 public:
  virtual ActivityKind kind() const = 0;
  // Of all that is to be done, what has been planned so far; nothing: unknown. 0 to 1.
  virtual std::optional<double> progress() const { return {}; }
  // After the last item was played.
  virtual std::optional<ActivityFault> fault() const { return {}; }
};

}  // namespace passo
