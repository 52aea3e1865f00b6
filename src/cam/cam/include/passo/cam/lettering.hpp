// letter: converts text to a drawing: the outlines of a font's glyphs, shaped as the script requires (kerning,
// ligatures, Arabic).
//
// Lines are separated by '\n' and placed below each other; the first baseline is at Y0. Right-to-left lines are
// supported; a line that mixes both directions takes the direction of its first letter. With `around` the baseline is a
// circle about the origin, with the text centred at its top, or at its bottom if `around` is negative; at the bottom
// the letters stand inside the circle. `arc` spreads a line over an angular range: clockwise outside the circle,
// counterclockwise inside. A line longer than its arc is an error "engrave.too-long".
//
// With a single-line font (.lff, .jhf) the paths of the drawing are the strokes, most of them open.
//
// A missing glyph is an error "engrave.no-letter", an invalid font file an error "engrave.no-font".
//
// Sources: FreeType 2 (outlines), HarfBuzz (shaping).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "passo/cam/drawing.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

enum class LetterAlign : std::uint8_t { left, middle, right };

// Angles in degrees, counterclockwise from the X axis.
struct LetterArc {
  double from = 0;
  double to = 0;
};

struct Lettering {
  std::string text = {};    // the text in UTF-8
  Mm height{10};            // capital letter height
  double line_space = 1.6;  // line spacing between baselines, in letter heights
  LetterAlign align = LetterAlign::left;
  Mm around{0};                       // radius of the baseline; 0: a straight line
  std::optional<LetterArc> arc = {};  // the range on that circle; empty: the natural length of the text
  double turn_degrees = 0;            // rotation of the whole text about the origin, counterclockwise
  int face = 0;                       // the font in the file; see FontFile
  Mm tolerance{0.005};
};

// `name`: the name of the font file. Reports errors in `diagnostics`.
Drawing letter(const Lettering& lettering, const std::string& name, std::string_view font, Diagnostics& diagnostics);
// Does the same with built_in_stroke_font().
Drawing letter_simplex(const Lettering& lettering, Diagnostics& diagnostics);

}  // namespace passo
