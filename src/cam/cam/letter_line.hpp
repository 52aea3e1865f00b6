// LetterLine: positions the letters of a line of text on a straight line, a circle or an arc. Private to cam/.
#pragma once

#include <string>
#include <string_view>

#include "drawing_builder.hpp"

#include "passo/cam/lettering.hpp"
#include "passo/cam/stroke_font.hpp"

namespace passo {

struct LetterSpot {
  double x = 0;
  double y = 0;
};

class LetterLine {
 public:
  LetterLine() = default;
  // `length`: length of the line, mm. `letters`: number of its letters.
  LetterLine(const Lettering& lettering, double length, std::size_t letters);

  // Whether the line is longer than its arc.
  bool is_too_long() const { return is_too_long_; }
  double begin() const { return begin_; }  // start of the first letter
  double space() const { return space_; }  // extra space after each letter
  // Maps a point of the line to the drawing; `middle` is the centre of its letter. Letters are rotated, not bent.
  LetterSpot placed(double x, double y, double middle) const;

 private:
  double radius_ = 0;
  double turn_ = 0;  // radians
  double begin_ = 0;
  double space_ = 0;
  bool is_too_long_ = false;
};

// Calls write(words, base_line) for each line of the text.
template <class Write>
void for_letter_lines(const Lettering& lettering, const Write& write) {
  std::string_view rest = lettering.text;
  for (int line = 0; !rest.empty(); ++line) {
    const std::string_view words = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(rest.size(), words.size() + 1));
    write(words, -line * lettering.line_space * lettering.height.value());
  }
}

void refuse_letter(const std::string& font, std::string_view character, Diagnostics& diagnostics);
void refuse_long_line(const std::string& font, std::string_view words, Diagnostics& diagnostics);

// Implements letter() for a single-line font.
Drawing letter_strokes(const Lettering& lettering, const std::string& name, const StrokeFont& font,
                       Diagnostics& diagnostics);

}  // namespace passo
