// Sheet: the common elements of pictures: colours, fonts and pens, white paper, a title with a line below it, and a
// legend. Private to report/.
#pragma once

#include <string>
#include <vector>

#include "canvas.hpp"

namespace passo {

namespace sheet {
inline constexpr Colour paper{1, 1, 1};
inline constexpr Colour ink{0.25, 0.27, 0.30};
inline constexpr Colour quiet_ink{0.48, 0.50, 0.54};
inline const Font title{.size = 26, .colour = {0.13, 0.14, 0.17}, .bold = true};
inline const Font subtitle{.size = 15, .colour = {0.40, 0.42, 0.46}};
inline const Font caption{.size = 14};
inline const Font label{.size = 12};
inline const Font axis_title{.size = 14, .colour = quiet_ink};
inline const Pen grid{.colour = {0.90, 0.91, 0.92}, .width = 0.8};
inline const Pen edge{.colour = {0.62, 0.64, 0.67}, .width = 1};
inline constexpr double margin = 48;
inline constexpr double mark = 5;  // length of a tick mark
}  // namespace sheet

// Fills the paper with white, and writes the title (options.program) and `words` below it.
void begin_sheet(Canvas& canvas, const PictureOptions& options, const std::string& words);
// Does the same with options.machine below the title.
void begin_sheet(Canvas& canvas, const PictureOptions& options);

// Explains the strokes, areas and dots of a picture in one row, from left to right.
class Legend {
 public:
  Legend(Canvas& canvas, Spot place) : canvas_(canvas), place_(place) {}

  void line(const Pen& pen, const std::string& words);
  void patch(const Colour& colour, const std::string& words);
  void dot(double radius, const Colour& colour, const std::string& words);
  void words(const std::string& words);

  // Returns the width of a legend that has a line for each of these words.
  static double width_of_lines(Canvas& canvas, const std::vector<std::string>& words);

 private:
  Canvas& canvas_;
  Spot place_;
};

}  // namespace passo
