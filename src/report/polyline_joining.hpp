// Joins neighbouring pieces of a recorded path that run nearly straight at nearly the same speed. Private to report/.
#pragma once

#include <vector>

#include "passo/report/path_recorder.hpp"

namespace passo {

// Every vertex that is left out is within `tolerance` of the piece that replaces it. Pieces whose kind or speed differs
// from their neighbours' stay, unless they are shorter than `tolerance`. Speeds within `speed_step` count as equal.
void join_pieces(std::vector<PathRecorder::Vertex>& vertices, double tolerance, double speed_step);

}  // namespace passo
