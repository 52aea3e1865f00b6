// Canvas: cairo's C interface in a few words of drawing. Private to report/.
//
// Coordinates are units of the picture, x to the right and y down from the upper left corner. Owns surface and
// context; errors are kept by cairo and told by finish().
#pragma once

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
  // From left to right: the map of speeds.
  void fill_with_speeds(const Area& area);
  void frame(const Area& area, const Pen& pen);
  void line(Spot from, Spot to, const Pen& pen);
  void disc(Spot centre, double radius, const Colour& colour);
  // `y` is the middle of the digits' height.
  void text(Spot place, const std::string& text, const Font& font, Align align = Align::left);
  double text_width(const std::string& text, const Font& font);

  // A path with several beginnings, drawn by stroke().
  void move_to(Spot spot);
  void line_to(Spot spot);
  void stroke(const Pen& pen);

  // What is drawn between the two shows inside `area` only.
  void clip(const Area& area);
  void end_clip();

  // Writes what is not written yet.
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
  std::unique_ptr<cairo_t, Free> context_;  // goes before its surface
};

}  // namespace passo
