// plan_profile: cuts along the lines of a drawing: around parts, inside loops, or with the cutter's middle on the line.
//
// What lies inside is cut before what lies around it. Depths, tabs, ramps, leads and dog-bones are those of
// plan_outline(). On the line, open paths are cut there and back, a step deeper at each end.
//
// Where two lines are nearer to each other than the cutter needs, and in inner corners, some of the ground along the
// line stays: it is told as `unreached`. A loop that the cutter does not fit into is a warning
// "outline.narrow-opening".
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "passo/cam/drawing.hpp"
#include "passo/cam/outline.hpp"

namespace passo {

// part: outside the outermost loops, inside the loops in them, and so on in turn. outside, inside: of each loop.
enum class ProfileSide : std::uint8_t { part, outside, inside, on };

struct ProfileOptions {
  OutlineOptions cut = {};
  ProfileSide side = ProfileSide::part;
};

struct ProfilePlan {
  OutlinePlan outline = {};
  std::size_t lines = 0;  // open paths that are cut
  Region face = {};       // what the loops fill; of `on` nothing
  Region unreached = {};
  double unreached_mm2 = 0;
};

// `loops`: the last point leads back to the first. `lines`: open paths, which are cut on the line alone.
// Errors "outline.…" and "profile.…" are in `diagnostics`.
ProfilePlan plan_profile(const std::vector<std::vector<PathPoint>>& loops,
                         const std::vector<std::vector<PathPoint>>& lines, const ProfileOptions& options,
                         Diagnostics& diagnostics);

}  // namespace passo
