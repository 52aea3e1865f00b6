// Joins neighbouring pieces of a recorded path that run nearly straight at nearly the same speed. Private to report/.
#pragma once

#include <vector>

#include "passo/report/path_recorder.hpp"

namespace passo {

// Every vertex that is left out is within `tolerance` of the piece that replaces it. A piece stays if its kind or speed
// differs from its neighbours', unless the piece is shorter than `tolerance`. Speeds within `speed_step` count as
// equal.
void join_pieces(std::vector<PathRecorder::Vertex>& vertices, double tolerance, double speed_step);

}  // namespace passo
