// The colours by which shapes of drawings are selected.
#pragma once

#include <string_view>

namespace passo {

// Whether the text can be the colour of a shape: "red" or another name of CSS, "#f00", "#ff0000", "rgb(255, 0, 0)", or
// a number of the palette of DXF, 0 to 256.
bool is_drawn_colour(std::string_view text);

}  // namespace passo
