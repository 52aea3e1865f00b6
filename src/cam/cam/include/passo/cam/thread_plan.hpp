// plan_threads: the helices of a thread mill, for threads in bores and on bosses.
//
// Position in the pipeline: write_mill_program() writes the plan. Z is that of the cutter's tip; the lowest is `depth`.
// One tooth cuts the whole thread along one helix; a mill with several teeth needs one turn, and another turn for each
// further length of its teeth. In a bore the cutter reaches the wall on a half circle from the middle; it is on the
// thread's helix there too, so it cuts nothing outside of the thread. On a boss it comes from outside, on a half circle
// at constant Z.
//
// Climb milling of a right-hand thread in a bore goes from the bottom up. The other hand, a boss instead of a bore, or
// conventional milling: each reverses the direction.
//
// Invariant: the tooth never goes beyond the thread's outline (in a bore the major diameter, on a boss the root), and
// rises by one pitch per turn, each to a nanometre.
#pragma once

#include <cstdint>
#include <vector>

#include "passo/cam/mill_plan.hpp"
#include "passo/cam/thread_size.hpp"

namespace passo {

struct ThreadOptions {
  ThreadSize size = {};
  Nanometres cutter = {};    // diameter over the tips of the teeth
  Nanometres depth = {};     // lowest Z of the tip, negative
  Nanometres oversize = {};  // of the major diameter of a bore; on a boss, the root is smaller by it
  std::uint32_t teeth = 1;   // along the axis, one pitch apart
  std::uint32_t passes = 1;  // equal areas of chip
  bool is_external = false;  // on a boss
  bool is_left_hand = false;
  bool climb = true;
  DrawnPoint park = {};
};

struct ThreadPlan {
  MillPlan mill = {};
  std::size_t turns = 0;  // of one pass
  bool goes_up = true;
  double feed_factor = 1;  // of the cutter's centre, to that of the tooth at the thread's outline
};

// `places`: the axes of the threads. The options must be valid: the cutter is narrower than the minor diameter of a
// bore.
ThreadPlan plan_threads(const std::vector<DrawnPoint>& places, const ThreadOptions& options);

}  // namespace passo
