// Text in the letters of a font of single lines, and where the letters of any line stand.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "letter_line.hpp"
#include <fmt/format.h>

#include "passo/diagnostics/file_bytes.hpp"

namespace passo {
namespace {

constexpr double turned_degree = std::numbers::pi / 180;

class StrokeLetterer {
 public:
  StrokeLetterer(const Lettering& lettering, const std::string& name, const StrokeFont& font, Diagnostics& diagnostics)
      : lettering_(lettering),
        name_(name),
        font_(font),
        diagnostics_(diagnostics),
        builder_(name, diagnostics),
        scale_(lettering.height.value() / font.capital) {
    builder_.layer("");
  }

  Drawing letter() {
    for_letter_lines(lettering_, [&](std::string_view words, double base_line) { write(words, base_line); });
    return builder_.take();
  }

 private:
  void write(std::string_view words, double base_line);
  void draw(const StrokeLetter& letter, const LetterLine& line, double x, double y);

  const Lettering& lettering_;
  const std::string& name_;
  const StrokeFont& font_;
  Diagnostics& diagnostics_;
  DrawingBuilder builder_;
  double scale_;  // mm of a unit of the font
};

std::string utf8_of(char32_t code) {
  std::string text;
  const auto add = [&](char32_t byte) { text += static_cast<char>(static_cast<unsigned char>(byte)); };
  if (code < 0x80) {
    add(code);
  } else if (code < 0x800) {
    add(0xC0U | code >> 6U);
    add(0x80U | (code & 0x3FU));
  } else {
    if (code >= 0x10000) add(0xF0U | code >> 18U);
    add(code < 0x10000 ? 0xE0U | code >> 12U : 0x80U | (code >> 12U & 0x3FU));
    add(0x80U | (code >> 6U & 0x3FU));
    add(0x80U | (code & 0x3FU));
  }
  return text;
}

void StrokeLetterer::write(std::string_view words, double base_line) {
  std::vector<const StrokeLetter*> letters;
  double length = 0;
  for (const char32_t code : characters_of(words)) {
    if (code == U'\r') continue;
    const auto found = font_.letters.find(code);
    if (found == font_.letters.end()) {
      refuse_letter(name_, utf8_of(code), diagnostics_);
      continue;
    }
    letters.push_back(&found->second);
    length += found->second.advance * scale_;
  }
  const LetterLine line(lettering_, length, letters.size());
  if (line.is_too_long()) return refuse_long_line(name_, words, diagnostics_);
  double x = line.begin();
  for (const StrokeLetter* letter : letters) {
    draw(*letter, line, x, base_line);
    x += letter->advance * scale_ + line.space();
  }
}

void StrokeLetterer::draw(const StrokeLetter& letter, const LetterLine& line, double x, double y) {
  const double middle = x + letter.advance * scale_ / 2;
  for (const std::vector<StrokePoint>& stroke : letter.strokes) {
    if (!builder_.has_room_for(stroke.size() + 1, {}, "")) return;
    DrawnPath path;
    const auto put = [&](double along, double up, double bulge) {
      const LetterSpot spot = line.placed(along, up, middle);
      if (const auto at = builder_.point(Mm(spot.x), Mm(spot.y), {}, "")) path.points.push_back({*at, bulge});
    };
    for (const StrokePoint& point : stroke) put(x + point.x * scale_, y + point.y * scale_, point.bulge);
    if (stroke.size() == 1) {
      // A dot is a line that is too short to be seen.
      constexpr double dot_mm = 0.02;
      put(x + stroke.front().x * scale_ + dot_mm, y + stroke.front().y * scale_, 0);
    }
    if (path.points.size() > 2 && path.points.front().at == path.points.back().at) {
      path.points.pop_back();
      path.is_closed = true;
    }
    builder_.add_path(std::move(path));
  }
}

}  // namespace

LetterLine::LetterLine(const Lettering& lettering, double length, std::size_t letters)
    : radius_(lettering.around.value()), turn_(lettering.turn_degrees * turned_degree) {
  const double share = lettering.align == LetterAlign::left ? 0 : lettering.align == LetterAlign::right ? 1 : 0.5;
  begin_ = radius_ != 0 ? -length / 2 : -share * length;
  if (radius_ == 0 || !lettering.arc) return;
  // Outside of a circle a text goes clockwise, inside counterclockwise.
  const auto [from, to] = *lettering.arc;
  double sweep = std::fmod(radius_ > 0 ? from - to : to - from, 360);
  if (sweep <= 0) sweep += 360;
  turn_ += radius_ > 0 ? (from - sweep / 2 - 90) * turned_degree : (from + sweep / 2 - 270) * turned_degree;
  const double room = sweep * turned_degree * std::abs(radius_);
  is_too_long_ = length > room * (1 + 1e-9);
  if (letters < 2) return;
  // On a whole circle the last letter has a space behind it, too.
  space_ = (room - length) / static_cast<double>(sweep == 360 ? letters : letters - 1);
  begin_ = -room / 2;
}

LetterSpot LetterLine::placed(double x, double y, double middle) const {
  double lean = turn_;
  LetterSpot spot{x, y};
  if (radius_ != 0) {
    lean -= middle / radius_;
    spot = {x - middle, y + radius_};
  }
  const double c = std::cos(lean);
  const double s = std::sin(lean);
  return {spot.x * c - spot.y * s, spot.x * s + spot.y * c};
}

void refuse_letter(const std::string& font, std::string_view character, Diagnostics& diagnostics) {
  diagnostics.add(of_file("engrave.no-letter", font, fmt::format("the font has no glyph for '{}'", character),
                          "another --font, or another text"));
}

void refuse_long_line(const std::string& font, std::string_view words, Diagnostics& diagnostics) {
  diagnostics.add(of_file("engrave.too-long", font, fmt::format("'{}' is longer than its arc", words),
                          "a lower --height, a wider --arc or a shorter text"));
}

Drawing letter_strokes(const Lettering& lettering, const std::string& name, const StrokeFont& font,
                       Diagnostics& diagnostics) {
  if (font.letters.empty()) return {.file = name};
  return StrokeLetterer(lettering, name, font, diagnostics).letter();
}

}  // namespace passo
