// Building blocks for HTML pages: escaped text, and embedded pictures.
#pragma once

#include <string>
#include <string_view>

namespace passo {

// Escapes all characters that have a meaning in HTML as entities, for use in elements and quoted attributes. Control
// characters and invalid UTF-8 become U+FFFD.
std::string html_text(std::string_view text);

// Returns a picture of draw_view() as an <svg> element, which fills the width of its container. `name` (letters) makes
// the picture's ids unique in the page. `label`: a description of the picture.
std::string inline_svg(std::string_view svg, std::string_view name, std::string_view label);
// Does the same for a PNG: an <img> element with embedded data.
std::string inline_png(std::string_view png, std::string_view label);

// Encodes bytes in base64.
std::string base64(std::string_view bytes);

}  // namespace passo
