// plan_profile: cuts along the lines of a drawing: around parts, inside loops, or with the cutter centred on the line.
//
// Inner loops are cut before the loops around them. Depths, tabs, ramps, lead-ins and dog-bones work as in
// plan_outline(). With the cutter centred on the line, open paths are cut back and forth, one step deeper at each end.
//
// If two lines are closer than the cutter requires, and in inner corners, some material along the line remains: it is
// reported as `unreached`. A loop that the cutter does not fit into causes a warning "outline.narrow-opening".
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "passo/cam/drawing.hpp"
#include "passo/cam/outline.hpp"

namespace passo {

// part: outside the outermost loops, inside the loops within them, and so on alternately. outside, inside: of every
// loop.
enum class ProfileSide : std::uint8_t { part, outside, inside, on };

struct ProfileOptions {
  OutlineOptions cut = {};
  ProfileSide side = ProfileSide::part;
};

struct ProfilePlan {
  OutlinePlan outline = {};
  std::size_t lines = 0;  // number of open paths that are cut
  std::size_t dots = 0;
  Region face = {};  // the area inside the loops; empty for `on`
  Region unreached = {};
  double unreached_mm2 = 0;
};

// `loops`: closed; the last point leads back to the first. `lines`: open paths, which are always cut on the line; a
// path of a single point is a dot, at which the cutter only plunges. Reports errors "outline.…" and "profile.…" in
// `diagnostics`.
ProfilePlan plan_profile(const std::vector<std::vector<PathPoint>>& loops,
                         const std::vector<std::vector<PathPoint>>& lines, const ProfileOptions& options,
                         Diagnostics& diagnostics);

}  // namespace passo
