// Planner: segments -> phases. Look-ahead as far as braking needs, in bounded memory.
//
//   v²    top ________                 The speed squared is a straight line over the way where the acceleration is
//        /|           \______          constant. Backwards from the last segment known: how fast may each be entered
//       / |           |      \         so that all speeds after it can still be met (braking)? Forwards: how fast is
//      /  |           |       \        it really, from rest on (accelerating)? Junctions cap both.
//     0 --+--junction-+--------+-- s
//
// Invariant: what is given ends at a speed from which the segments queued behind it can brake to rest, and is the
// same, bit for bit, as if the whole program had been planned at once, except after a queue of `most_queued_segments`
// did not reach the braking distance. Time: amortised constant a segment. See docs/decisions/0010 to 0012.
#pragma once

#include <cstddef>
#include <memory>

#include "passo/base/source.hpp"
#include "passo/geometry/axes.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo {

struct MotionLimits {
  PerAxis<MmPerSecond> velocity;
  PerAxis<MmPerSecond2> acceleration;
};

class Planner final : public Source<MotionItem> {
 public:
  // About 400 bytes each: 23 MiB when full.
  static constexpr std::size_t most_queued_segments = 60'000;

  Planner(Source<PathItem>& path, const MotionLimits& limits, std::size_t most_queued = most_queued_segments);
  ~Planner() override;

  [[nodiscard]] bool next(MotionItem& item) override;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace passo
