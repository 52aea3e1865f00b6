// Canvas: a few drawing operations over cairo's C interface. Private to report/.
//
// Coordinates are in units of the picture: x to the right and y down, from the upper left corner. A Canvas owns its
// surface and context. cairo keeps the first error, and finish() returns it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "speed_colours.hpp"

#include "passo/report/output_file.hpp"
#include "passo/report/picture.hpp"

typedef struct _cairo cairo_t;                  // NOLINT: cairo's own names
typedef struct _cairo_surface cairo_surface_t;  // NOLINT

namespace passo {

struct Spot {
  double x = 0;
  double y = 0;
};

struct Area {
  double x = 0;
  double y = 0;
  double width = 0;
  double height = 0;
  double right() const { return x + width; }
  double bottom() const { return y + height; }
};

// A picture made of pixels, row by row from the upper left corner: 0xAARRGGBB, the colours multiplied by A.
struct PixelMap {
  int width = 0;
  int height = 0;
  std::vector<std::uint32_t> pixels;
};

struct Pen {
  Colour colour;
  double width = 1;
  double opacity = 1;
  std::vector<double> dashes = {};
};

enum class Align : std::uint8_t { left, centre, right };

struct Font {
  double size = 13;
  Colour colour = {0.25, 0.27, 0.30};
  bool bold = false;
};

class Canvas {
 public:
  Canvas(const PictureOptions& options, OutputFile& file);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  void fill(const Area& area, const Colour& colour);
  void fill(const std::vector<Spot>& polygon, const Colour& colour, double opacity = 1);
  // Fills the area with the map of speeds, from left to right.
  void fill_with_speeds(const Area& area);
  // Fills the area with the pixels.
  void image(const Area& area, PixelMap map);
  void frame(const Area& area, const Pen& pen);
  void line(Spot from, Spot to, const Pen& pen);
  void disc(Spot centre, double radius, const Colour& colour);
  // The y of `place` is at the middle of the digits' height.
  void text(Spot place, const std::string& text, const Font& font, Align align = Align::left);
  double text_width(const std::string& text, const Font& font);

  // These two build a path, which may have several pieces. stroke() draws the path. fill_path() fills what an odd
  // number of its pieces surround, so a piece in another is a hole.
  void move_to(Spot spot);
  void line_to(Spot spot);
  void stroke(const Pen& pen);
  void fill_path(const Colour& colour);

  // Between clip() and end_clip(), drawing shows only inside `area`.
  void clip(const Area& area);
  void end_clip();

  // Writes what is left. Returns cairo's error, if there was one.
  Status<OutputError> finish();

 private:
  struct Free {
    void operator()(cairo_t* context) const;
    void operator()(cairo_surface_t* surface) const;
  };

  void use(const Font& font);

  PictureFormat format_;
  OutputFile& file_;
  std::unique_ptr<cairo_surface_t, Free> surface_;
  std::unique_ptr<cairo_t, Free> context_;  // must be destroyed before its surface, so it is declared after it
};

}  // namespace passo
