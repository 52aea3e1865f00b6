// Renders a piece of stock with lighting: from above, and as a 3D view. Private to report/.
#pragma once

#include "canvas.hpp"
#include "projection.hpp"

#include "passo/report/stock_picture.hpp"

namespace passo {

// Returns a pixel of a PixelMap. bright: 1 is the colour itself.
std::uint32_t pixel_of(const Colour& colour, double bright);

// The colours of deviations, and of areas without deviation.
inline constexpr Colour left_colour{0.16, 0.42, 0.86};
inline constexpr Colour gouge_colour{0.86, 0.16, 0.14};
inline constexpr Colour even_colour{0.80, 0.80, 0.79};
// The colour of uncut material.
inline constexpr Colour untouched_colour{0.87, 0.84, 0.78};

class StockShading {
 public:
  explicit StockShading(const StockDrawing& drawing);

  double deepest() const { return deepest_; }      // mm below the top
  double largest_left() const { return left_; }    // mm
  double largest_gouge() const { return gouge_; }  // mm

  // Return the unlit colour of a depth below the top, and of a deviation (positive: excess material).
  Colour colour_of_depth(double depth) const;
  Colour colour_of_difference(double difference) const;

  // Renders the top view, X to the right and Y up, with this many pixels.
  PixelMap from_above(int width, int height) const;
  // Renders the 3D view of `projection` in `area`, with `scale` pixels per unit.
  PixelMap as_body(const Projection& projection, const Area& area, int scale) const;

 private:
  // A piece of the surface: its height and its lit colour.
  struct Patch {
    double height = 0;
    std::uint32_t colour = 0;
    std::uint32_t wall = 0;  // the wall below it, seen from the side
  };
  Patch patch(double column, double row, double size) const;
  double height_near(double column, double row) const;

  const StockDrawing& drawing_;
  double deepest_ = 0;
  double left_ = 0;
  double gouge_ = 0;
};

}  // namespace passo
