// StrokeFont: a single-line font, for engraving and for plotter labels.
//
// Supports the fonts of LibreCAD (.lff) and those of A. V. Hershey in the format of J. Hurt (.jhf). A .jhf file has no
// character codes: its letters are ASCII from the space on. Lengths are in font units; Y0 is the baseline.
//
// Invalid input produces diagnostics "font.…" with a line number. Time and memory are proportional to the text.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

// The bulge defines the connection to the next point, as in PathPoint.
struct StrokePoint {
  double x = 0;
  double y = 0;
  double bulge = 0;
};

struct StrokeLetter {
  double advance = 0;                                  // distance to the next letter
  std::vector<std::vector<StrokePoint>> strokes = {};  // a stroke of one point is a dot
};

struct StrokeFont {
  double capital = 0;  // capital letter height; above 0
  std::map<char32_t, StrokeLetter> letters = {};
};

// Reports errors in `diagnostics`; the font then has no letters.
StrokeFont read_stroke_font(const std::string& name, std::string_view text, Diagnostics& diagnostics);

// Returns whether the beginning of the text looks like a font of these formats.
bool looks_like_stroke_font(std::string_view text);

// Returns the Hershey font "Roman Simplex" (ASCII). Its data and the acknowledgement required by its licence are in
// hershey_simplex.cpp.
const StrokeFont& built_in_stroke_font();

// Decodes UTF-8; an invalid byte becomes U+FFFD.
std::vector<char32_t> characters_of(std::string_view text);

}  // namespace passo
