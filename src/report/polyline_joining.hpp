// Joining neighbouring pieces of a recorded path that run nearly straight at nearly the same speed. Private to report/.
#pragma once

#include <vector>

#include "passo/report/path_recorder.hpp"

namespace passo {

// No vertex that is left out was farther than `tolerance` from the piece that replaces it. Pieces of another kind or
// speed than their neighbours stay, unless they are shorter than `tolerance`; speeds are alike within `speed_step`.
void join_pieces(std::vector<PathRecorder::Vertex>& vertices, double tolerance, double speed_step);

}  // namespace passo
