// A picture of the limits of ramp tables of several sizes, over the motor's steps per revolution: the minimum
// acceleration with which a rate is reached at the end of the table, and the rate reached with several accelerations.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "passo/ramp/ramp_setup.hpp"
#include "passo/report/output_file.hpp"
#include "passo/report/picture.hpp"

namespace passo {

struct RampLimitScene {
  std::vector<std::int32_t> table_sizes;         // at most three
  std::optional<Hertz> rate;                     // the required rate; empty: the minimum acceleration is not shown
  std::vector<RadiansPerSecond2> accelerations;  // at least one, in ascending order
  std::int32_t least_steps_per_turn = 24;
  std::int32_t most_steps_per_turn = 400;
};

// `options.program` is the title, `options.machine` the line below it. Draws into `file`; the caller commits it.
Status<OutputError> draw_ramp_limits(const RampLimitScene& scene, const PictureOptions& options, OutputFile& file);

}  // namespace passo
