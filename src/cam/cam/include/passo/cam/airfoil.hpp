// read_airfoil: the section of a wing from a file of coordinates (.dat), as a closed path.
//
// Read are both forms that are around: Selig's, from the trailing edge over the upper side to the nose and back below,
// and Lednicer's, with the numbers of points in the second line, and each side from the nose on. The section is scaled
// so that it is as long as the chord; X0 Y0 stays where the file has it, mostly the nose.
//
// A hostile text gives diagnostics "airfoil.…" with a line.
//
// Source: UIUC Airfoil Coordinates Database, M. Selig.
#pragma once

#include <string>
#include <string_view>

#include "passo/cam/drawing.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

Drawing read_airfoil(const std::string& name, std::string_view text, Mm chord, Diagnostics& diagnostics);

// Whether lines of two numbers begin in the first lines.
bool looks_like_airfoil(std::string_view text);

}  // namespace passo
