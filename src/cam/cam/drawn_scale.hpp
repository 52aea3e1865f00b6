// words_on_scale: detects drill drawings that were probably read in the wrong unit. Private to cam/.
#pragma once

#include <string>

#include "passo/cam/drawing.hpp"

namespace passo {

// Returns what seems wrong with the scale of the drawing and what to try; empty if nothing does. Examines the hole
// diameters or, if the holes have none, whether their spacing is ten times or a tenth of the usual 2.54 mm pitch.
std::string words_on_scale(const Drawing& drawing);

}  // namespace passo
