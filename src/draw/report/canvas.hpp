// Canvas: a few drawing operations, the same for SVG and PNG. Private to report/.
//
// Coordinates are in picture units: x to the right and y down, from the upper left corner. The Ink of the format
// generates the picture; it keeps its first error, which finish() returns.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "speed_colours.hpp"

#include "passo/report/output_file.hpp"
#include "passo/report/picture.hpp"

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

// A pixel image, row by row from the upper left corner: 0xAARRGGBB, the colours premultiplied by A.
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

// Draws a picture in one format. A path may have several pieces; stroke() and fill() reset it.
class Ink {
 public:
  virtual ~Ink() = default;
  virtual void move_to(Spot spot) = 0;
  virtual void line_to(Spot spot) = 0;
  virtual void close() = 0;
  virtual void stroke(const Pen& pen) = 0;
  // even_odd: a piece within another one is a hole.
  enum class Rule : std::uint8_t { winding, even_odd };
  virtual void fill(const Colour& colour, double opacity, Rule rule) = 0;
  virtual void fill_with_speeds(const Area& area) = 0;
  virtual void disc(Spot centre, double radius, const Colour& colour) = 0;
  virtual void image(const Area& area, PixelMap map) = 0;
  // The y of `place` is the baseline.
  virtual void text(Spot place, const std::string& text, const Font& font, Align align) = 0;
  virtual double text_width(const std::string& text, const Font& font) = 0;
  virtual void clip(const Area& area) = 0;
  virtual void end_clip() = 0;
  virtual Status<OutputError> finish() = 0;
};

class Canvas {
 public:
  Canvas(const PictureOptions& options, OutputFile& file);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  void fill(const Area& area, const Colour& colour);
  void fill(const std::vector<Spot>& polygon, const Colour& colour, double opacity = 1);
  // Fills the area with the colour map of speeds, from left to right.
  void fill_with_speeds(const Area& area);
  // Fills the area with the pixels.
  void image(const Area& area, PixelMap map);
  void frame(const Area& area, const Pen& pen);
  void line(Spot from, Spot to, const Pen& pen);
  void disc(Spot centre, double radius, const Colour& colour);
  // The y of `place` is the middle of the digits' height.
  void text(Spot place, const std::string& text, const Font& font, Align align = Align::left);
  double text_width(const std::string& text, const Font& font);

  // Build a path, which may have several pieces. stroke() draws the path. fill_path() fills by the even-odd rule, so a
  // piece within another one is a hole.
  void move_to(Spot spot);
  void line_to(Spot spot);
  void stroke(const Pen& pen);
  void fill_path(const Colour& colour);

  // Limits drawing to `area` until end_clip().
  void clip(const Area& area);
  void end_clip();

  // Writes the remaining output. Returns the first error, if there was one.
  Status<OutputError> finish();

 private:
  void outline(const Area& area);

  std::unique_ptr<Ink> ink_;
};

}  // namespace passo
