// The valid names of pictures, the same for every command that draws.
#pragma once

#include <string>

#include "passo/report/picture.hpp"

namespace passo {

// Returns why a picture cannot have this name. Empty if the name is valid, or if no picture is requested.
inline std::string refuse_picture(const std::string& path) {
  if (path.empty() || picture_format_of(path)) return "";
  return path + ": the name of a picture must end with .svg or .png";
}

}  // namespace passo
