// SpeedColours: the colour for each speed. Private to report/.
//
// Viridis (Smith and van der Walt, matplotlib, CC0) is perceptually even. The colour-blind can read it, and it can be
// read in grey. It is used backwards: the full speed of most of a path is dark on white paper, and slow places are
// bright. The palest fifth is left out, because it would hardly show on paper. The darkest tenth is left out, because
// it looks black. Speeds are sorted into a few classes, so that neighbouring pieces become one stroke.
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
  // `share`, 0…1, is a place in the map.
  static Colour at(double share);
  static Colour of_class(std::size_t index) { return at((static_cast<double>(index) + 0.5) / classes); }

 private:
  double fastest_;
};

}  // namespace passo
