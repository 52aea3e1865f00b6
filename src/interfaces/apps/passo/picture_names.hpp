// What the names of pictures may be: the same for each command that draws.
#pragma once

#include <string>

#include "passo/report/picture.hpp"

namespace passo {

// Why a picture cannot have this name. Empty: it can, or none is wanted.
inline std::string refuse_picture(const std::string& path) {
  if (path.empty() || picture_format_of(path)) return "";
  return path + ": the name of a picture must end with .svg or .png";
}

}  // namespace passo
