// SpeedColours: the colour for each speed. Private to report/.
//
// Viridis (Smith and van der Walt, matplotlib, CC0) is perceptually uniform, and legible for the colour-blind and in
// greyscale. It is used in reverse: the full speed of most of a path is dark on white paper, and slow points are
// bright. The palest fifth is omitted, because it would hardly be visible on paper, and the darkest tenth, because it
// looks black. Speeds are grouped into a few classes, so that adjacent pieces are drawn as one stroke.
#pragma once

#include <array>
#include <cstddef>

#include "passo/units/units.hpp"

namespace passo {

struct Colour {
  double red = 0;
  double green = 0;
  double blue = 0;
};

class SpeedColours {
 public:
  static constexpr std::size_t classes = 32;

  explicit SpeedColours(MmPerSecond top) : fastest_(top.value()) {}

  std::size_t class_of(double speed) const;
  // `share`, 0…1, is the position in the colour map.
  static Colour at(double share);
  static Colour of_class(std::size_t index) { return at((static_cast<double>(index) + 0.5) / classes); }

 private:
  double fastest_;
};

}  // namespace passo
