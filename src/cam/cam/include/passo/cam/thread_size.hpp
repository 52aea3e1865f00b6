// ThreadSize: the basic dimensions of a screw thread with flanks of 60 degrees, from its name.
//
// Names: "M6" and "M8x1" (metric), "1/4-20", "#8-32" and "1/4 UNC" (unified). The pitches of "M6" and "1/4 UNC" are
// those of the coarse series: ISO 261 and ASME B1.1. The minor diameters follow ISO 724 and ASME B1.1, which have the
// same basic profile.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "passo/cam/drawing.hpp"

namespace passo {

struct ThreadSize {
  std::string name = {};  // "M6x1"
  Nanometres major = {};
  double pitch_nm = 0;  // not whole for most threads in inches

  // The diameter of the bore of a nut.
  Nanometres minor() const;
  // The diameter at the roots of a bolt.
  Nanometres root() const;
};

// Nothing if the name is none of these, or if the pitch is too large for the diameter.
std::optional<ThreadSize> thread_size_of(std::string_view name);
// A thread of any diameter and pitch. Nothing if the pitch is 0, or too large for the diameter.
std::optional<ThreadSize> thread_size_of(Nanometres major, Nanometres pitch);

}  // namespace passo
