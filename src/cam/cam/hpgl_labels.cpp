#include "hpgl_labels.hpp"

#include <algorithm>
#include <cmath>

#include "passo/cam/stroke_font.hpp"

namespace passo {
namespace {

constexpr double cell_widths = 1.5;  // of a letter
constexpr double line_heights = 2;

// Along the line, and up from it.
HpglSpot placed(const HpglLabels& labels, HpglSpot from, double along, double up) {
  const double c = std::cos(labels.direction);
  const double s = std::sin(labels.direction);
  return {from.x + along * c - up * s, from.y + along * s + up * c};
}

// The middle of a letter lies in the middle of its cell, as wide as an H is.
void draw_letter(const StrokeLetter& letter, const HpglLabels& labels, HpglSpot from, HpglPen& pen) {
  const StrokeFont& font = built_in_stroke_font();
  const double high = labels.height / font.capital;
  const double wide = labels.width / font.letters.at(U'H').advance;
  for (const std::vector<StrokePoint>& stroke : letter.strokes) {
    bool is_first = true;
    for (const StrokePoint& point : stroke) {
      const double up = point.y * high;
      const double along = labels.width / 2 + (point.x - letter.advance / 2) * wide + up * labels.slant;
      const HpglSpot spot = placed(labels, from, along, up);
      is_first ? pen.move_to(spot) : pen.line_to(spot);
      is_first = false;
    }
  }
}

// Where the first letter begins, when the label's origin is at this place.
HpglSpot origin_of(std::string_view text, const HpglLabels& labels, HpglSpot at) {
  const int origin = labels.origin > 10 ? labels.origin - 10 : labels.origin;
  const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
  const double cell = labels.width * (cell_widths + cell_widths * labels.extra_x);
  const double width = std::max(0.0, static_cast<double>(line.size()) * cell - (cell - labels.width));
  const int column = (origin - 1) / 3;  // left, middle, right
  const int row = (origin - 1) % 3;     // bottom, middle, top
  double along = -width * column / 2;
  double up = -labels.height * row / 2;
  if (labels.origin > 10) {
    along += labels.width / 2 * (1 - column);
    up += labels.height / 2 * (1 - row);
  }
  return placed(labels, at, along, up);
}

}  // namespace

HpglSpot moved_by_cells(const HpglLabels& labels, HpglSpot from, double cells, double lines) {
  return placed(labels, from, cells * labels.width * cell_widths * (1 + labels.extra_x),
                lines * labels.height * line_heights * (1 + labels.extra_y));
}

std::size_t write_label(std::string_view text, HpglLabels& labels, HpglPen& pen) {
  const StrokeFont& font = built_in_stroke_font();
  std::size_t unknown = 0;
  HpglSpot at = origin_of(text, labels, pen.at());
  HpglSpot start = labels.origin == 1 ? labels.line_start : at;
  for (const char c : text) {
    if (c == '\r') {
      at = start;
    } else if (c == '\n') {
      at = moved_by_cells(labels, at, 0, -1);
      start = moved_by_cells(labels, start, 0, -1);
    } else if (c == '\b') {
      at = moved_by_cells(labels, at, -1, 0);
    } else if (static_cast<unsigned char>(c) >= ' ') {
      const auto letter = font.letters.find(static_cast<unsigned char>(c));
      if (letter != font.letters.end()) {
        draw_letter(letter->second, labels, at, pen);
      } else {
        ++unknown;
      }
      at = moved_by_cells(labels, at, 1, 0);
    }
  }
  labels.line_start = start;
  pen.move_to(at);
  return unknown;
}

}  // namespace passo
