// StrokeFont: letters of single lines, for engraving on the line and for plotters.
//
// Read are the fonts of LibreCAD (.lff) and those of A. V. Hershey in the form of J. Hurt (.jhf). A .jhf file has no
// codes: its letters are those of ASCII from the space on. Lengths are in units of the font, Y0 is the base line.
//
// A hostile text gives diagnostics "font.…" with a line. Time and memory are proportional to the text.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

// The bulge tells how the stroke goes on from here, as in PathPoint.
struct StrokePoint {
  double x = 0;
  double y = 0;
  double bulge = 0;
};

struct StrokeLetter {
  double advance = 0;                                  // to the next letter
  std::vector<std::vector<StrokePoint>> strokes = {};  // of one point: a dot
};

struct StrokeFont {
  double capital = 0;  // the height of a capital letter; above 0
  std::map<char32_t, StrokeLetter> letters = {};
};

// Errors are in `diagnostics`; the font then has no letters.
StrokeFont read_stroke_font(const std::string& name, std::string_view text, Diagnostics& diagnostics);

// Whether the text begins like a font of this kind.
bool looks_like_stroke_font(std::string_view text);

// "Roman Simplex" of the Hershey fonts: ASCII. Its data and the acknowledgement that its licence asks for are in
// hershey_simplex.cpp.
const StrokeFont& built_in_stroke_font();

// The characters of a text in UTF-8; a byte that is no part of a character is U+FFFD.
std::vector<char32_t> characters_of(std::string_view text);

}  // namespace passo
