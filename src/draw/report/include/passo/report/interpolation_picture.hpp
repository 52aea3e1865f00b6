// A picture of a move in steps: the grid, the ideal path, and the pulses of each method.
//
// A single method fills the picture, with its speed uniformity below. Several methods are drawn side by side. A move of
// three or more axes is drawn in two views, X Y and X Z. The move may have up to `most_pictured_pulses` pulses.
#pragma once

#include <string>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/report/output_file.hpp"
#include "passo/report/picture.hpp"
#include "passo/study/measure.hpp"

namespace passo {

inline constexpr std::int64_t most_pictured_pulses = 100'000;

struct StudiedMethod {
  Method method;
  Measures measures;
};

// Draws a checked move with each of the methods. There must be at least one method, and each must support the move.
// Draws into `file`; the caller commits it.
Status<OutputError> draw_interpolation(const StepMove& move, const std::vector<StudiedMethod>& methods,
                                       PictureFormat format, OutputFile& file);

}  // namespace passo
