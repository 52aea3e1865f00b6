// A picture of what ramp tables of several sizes can do, over the motor's steps a revolution: the least acceleration
// with which the end of the table reaches a rate, and the rate that is reached with several accelerations.
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
  std::optional<Hertz> rate;                     // the wanted rate; empty: the picture shows no least acceleration
  std::vector<RadiansPerSecond2> accelerations;  // at least one, rising
  std::int32_t least_steps_per_turn = 24;
  std::int32_t most_steps_per_turn = 400;
};

// `options.program` is the title, `options.machine` the line below it. Draws into `file`, which the caller commits.
Status<OutputError> draw_ramp_limits(const RampLimitScene& scene, const PictureOptions& options, OutputFile& file);

}  // namespace passo
