// HpglLabels: the state of a plotter's labels: size, direction and slant of letters. Private to cam/.
#pragma once

#include <string_view>

#include "hpgl_pen.hpp"

namespace passo {

struct HpglLabels {
  double width = 0;      // letter width, plotter units; a character cell is 1.5 times as wide
  double height = 0;     // capital letter height; a line is twice as high
  double direction = 0;  // direction of the text line, radians
  double slant = 0;      // tangent of the slant angle from upright
  double extra_x = 0;    // extra character spacing, in cells
  double extra_y = 0;
  int origin = 1;            // label origin, numbered as for LO
  HpglSpot line_start = {};  // position after a carriage return
};

// Returns the position this number of cells and lines away from `from`.
HpglSpot moved_by_cells(const HpglLabels& labels, HpglSpot from, double cells, double lines);
// Draws the text; the pen ends where the next letter would begin. Returns the number of characters that the font lacks.
std::size_t write_label(std::string_view text, HpglLabels& labels, HpglPen& pen);

}  // namespace passo
