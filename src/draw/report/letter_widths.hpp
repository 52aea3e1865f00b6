// How wide letters will be that a viewer draws: those of DejaVu Sans, the widest of the fonts that a picture asks for.
// Private to report/.
#pragma once

#include <string_view>

namespace passo {

// In sizes of the font. `text` may hold any bytes.
double width_of_letters(std::string_view text, bool bold);

}  // namespace passo
