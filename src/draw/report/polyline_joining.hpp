// Joins nearly collinear neighbouring pieces of a recorded path with nearly equal speed. Private to report/.
#pragma once

#include <vector>

#include "passo/report/path_recorder.hpp"

namespace passo {

// Every removed vertex is within `tolerance` of the piece that replaces it. A piece stays if its kind or speed differs
// from its neighbours', unless it is shorter than `tolerance`. Speeds within `speed_step` count as equal.
void join_pieces(std::vector<PathRecorder::Vertex>& vertices, double tolerance, double speed_step);

}  // namespace passo
