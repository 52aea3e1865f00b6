// What a page in HTML needs of this program: text that cannot break out of its place, and pictures inside the page.
#pragma once

#include <string>
#include <string_view>

namespace passo {

// The text with all characters that mean something in HTML as entities; good inside elements and inside quoted
// attributes. Control characters and bytes that are no UTF-8 become U+FFFD.
std::string html_text(std::string_view text);

// A picture of draw_view() as an element <svg>, which takes the width of its surroundings. `name` (letters) makes the
// ids of the picture differ from those of other pictures in the page. `label`: a description of the picture.
std::string inline_svg(std::string_view svg, std::string_view name, std::string_view label);
// The same for a PNG: an element <img> with the bytes inside.
std::string inline_png(std::string_view png, std::string_view label);

// Any bytes as letters and digits.
std::string base64(std::string_view bytes);

}  // namespace passo
