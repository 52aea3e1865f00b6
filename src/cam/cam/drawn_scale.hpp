// words_on_scale: whether a drawing of holes seems to be in another unit than it is read in. Private to cam/.
#pragma once

#include <string>

#include "passo/cam/drawing.hpp"

namespace passo {

// What seems wrong with the drawing's scale, and what to try; empty: nothing. Looks at the diameters of the holes, and
// where they have none, whether neighbours are multiples of ten or a tenth of the usual 2.54 mm apart.
std::string words_on_scale(const Drawing& drawing);

}  // namespace passo
