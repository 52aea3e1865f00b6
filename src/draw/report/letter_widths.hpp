// Estimates the width of letters in a viewer: that of DejaVu Sans, the widest of the fonts that a picture requests.
// Private to report/.
#pragma once

#include <string_view>

namespace passo {

// Returns the width in units of the font size. `text` may contain any bytes.
double width_of_letters(std::string_view text, bool bold);

}  // namespace passo
