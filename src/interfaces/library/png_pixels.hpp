// Decodes and encodes PNG files in memory. Private to library/.
#pragma once

#include <string>
#include <string_view>

#include "passo/library/picture.hpp"

namespace passo::v1 {

// Empty, if `bytes` is no PNG file.
Picture pixels_of(std::string_view bytes);

}  // namespace passo::v1
