// letter: text as a drawing: the outlines of a font's letters, shaped as the script asks (kerning, ligatures, Arabic).
//
// Lines are parted by '\n', and written one below the other; the first base line is Y0. A line of letters from right to
// left is written so; a line that mixes both directions is written in the one of its first letter. With `around` the
// base line is a circle about X0 Y0, with the text in the middle of its top, or of its bottom where `around` is below
// 0: then the letters stand inside. `arc` spreads a line from one angle to another: outside it goes clockwise, inside
// counterclockwise. A line longer than its arc is an error "engrave.too-long".
//
// With a font of single lines (.lff, .jhf) the paths of the drawing are its strokes, most of them open.
//
// A letter that the font has not is an error "engrave.no-letter", a file that is no font "engrave.no-font".
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

// Angles in degrees, counterclockwise from the direction of X.
struct LetterArc {
  double from = 0;
  double to = 0;
};

struct Lettering {
  std::string text = {};    // UTF-8
  Mm height{10};            // of a capital letter
  double line_space = 1.6;  // from base line to base line, in heights
  LetterAlign align = LetterAlign::left;
  Mm around{0};                       // radius; 0: a straight line
  std::optional<LetterArc> arc = {};  // of that circle; empty: as much of it as the text needs
  double turn_degrees = 0;            // of it all about X0 Y0, counterclockwise
  Mm tolerance{0.005};
};

// `name`: of the font's file. Errors are in `diagnostics`.
Drawing letter(const Lettering& lettering, const std::string& name, std::string_view font, Diagnostics& diagnostics);
// The same in the letters of built_in_stroke_font().
Drawing letter_simplex(const Lettering& lettering, Diagnostics& diagnostics);

}  // namespace passo
