// SpeedColours: what colour a speed has. Private to report/.
//
// Viridis (Smith and van der Walt, matplotlib, CC0): perceptually even, and readable by the colour-blind and in grey.
// Run backwards, so that the full speed of most of a path is dark on white paper and where it slows down is bright; the
// palest fifth is left out, for paper would swallow it, and the darkest tenth, which the eye takes for black. Speeds
// are sorted into few classes, so that neighbouring pieces become one stroke.
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

  explicit SpeedColours(MmPerSecond fastest) : fastest_(fastest.value()) {}

  std::size_t class_of(double speed) const;
  // `share` 0…1 of the map.
  static Colour at(double share);
  static Colour of_class(std::size_t index) { return at((static_cast<double>(index) + 0.5) / classes); }

 private:
  double fastest_;
};

}  // namespace passo
