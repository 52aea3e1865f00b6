// HpglLabels: how a plotter writes labels: the size, the direction and the slant of letters. Private to cam/.
#pragma once

#include <string_view>

#include "hpgl_pen.hpp"

namespace passo {

struct HpglLabels {
  double width = 0;      // of a letter, plotter units; a cell is half as wide again
  double height = 0;     // of a capital letter; a line is twice as high
  double direction = 0;  // of the line, radians
  double slant = 0;      // tangent of the angle from upright
  double extra_x = 0;    // more space, in cells
  double extra_y = 0;
  int origin = 1;            // of the label, as LO numbers it
  HpglSpot line_start = {};  // where a carriage return leads
};

// So many cells and lines away from the place.
HpglSpot moved_by_cells(const HpglLabels& labels, HpglSpot from, double cells, double lines);
// The pen ends where the next letter would begin. Returns how many characters no letter was there for.
std::size_t write_label(std::string_view text, HpglLabels& labels, HpglPen& pen);

}  // namespace passo
