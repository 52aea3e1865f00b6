// The colours of SVG shapes, by which a drawing's parts are selected. Private to cam/.
#pragma once

#include <string>
#include <string_view>

namespace passo {

// Returns a colour as "#rrggbb": from #f00, #ff0000, rgb(255, 0, 0) or a usual name. Other texts are returned in small
// letters.
std::string svg_colour(std::string_view text);

// Returns the colour of a shape: that of its line, or without a line that of its area. Both as in the file; empty: not
// set, so no line and a black area.
std::string drawn_colour(std::string_view stroke, std::string_view fill);

}  // namespace passo
