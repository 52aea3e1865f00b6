#include "passo/cam/stroke_font.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "hershey_simplex.hpp"
#include "text_lines.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

constexpr double most_font_length = 1e6;  // units: no letter is that large
constexpr std::size_t most_font_points = 4'000'000;
constexpr char32_t first_of_ascii = 0x20;

// "1.5" of "1.5;2". Nothing: no number, or one that no letter has.
std::optional<double> take_font_number(std::string_view& text) {
  double value = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || !(std::abs(value) <= most_font_length)) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

class StrokeFontReader {
 public:
  StrokeFontReader(const std::string& name, std::string_view text, Diagnostics& diagnostics)
      : name_(name), lines_(text), diagnostics_(diagnostics) {}

  StrokeFont read_lff();
  StrokeFont read_jhf();

 private:
  bool refuse(std::string_view at, std::string message, std::string expected);
  bool read_header(std::string_view line);
  bool begin_letter(std::string_view line);
  bool copy_letter(std::string_view line);
  bool read_stroke(std::string_view line);
  bool read_point(std::string_view part);
  void finish(double usual_capital, double letter_space);
  bool read_jhf_letter(std::string_view line, char32_t code);

  const std::string& name_;
  TextLines lines_;
  Diagnostics& diagnostics_;
  std::string_view line_;
  StrokeFont font_;
  StrokeLetter* letter_ = nullptr;
  std::vector<StrokePoint> stroke_;
  double letter_space_ = 3;
  double word_space_ = 6.75;
  std::size_t points_ = 0;
};

bool StrokeFontReader::refuse(std::string_view at, std::string message, std::string expected) {
  const bool is_in_line = at.data() >= line_.data() && at.data() <= line_.data() + line_.size();
  const auto column = is_in_line ? static_cast<std::uint32_t>(at.data() - line_.data()) + 1 : 1U;
  diagnostics_.add({.code = "font.syntax",
                    .file = name_,
                    .place = {lines_.number(), column, 1},
                    .message = std::move(message),
                    .expected = std::move(expected),
                    .text = std::string(line_)});
  font_ = {};
  return false;
}

bool StrokeFontReader::read_header(std::string_view line) {
  for (const auto& [key, value] : {std::pair("LetterSpacing:", &letter_space_), {"WordSpacing:", &word_space_}}) {
    const std::size_t found = line.find(key);
    if (found == std::string_view::npos) continue;
    std::string_view number = trimmed(line.substr(found + std::string_view(key).size()));
    const std::string_view all = number;
    const std::optional<double> read = take_font_number(number);
    if (!read) return refuse(all, "this is not a letter spacing", "a number in units of the font");
    *value = *read;
  }
  return true;
}

// "[0041] A" or "[#0041]".
bool StrokeFontReader::begin_letter(std::string_view line) {
  std::string_view digits = line.substr(line.find_first_not_of('[') == 2 ? 2 : 1);
  if (digits.starts_with('#')) digits.remove_prefix(1);
  std::uint32_t code = 0;
  const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), code, 16);
  if (fault != std::errc() || end == digits.data() + digits.size() || *end != ']' || code > 0x10FFFF) {
    return refuse(line, "this is not a character code", "a hexadecimal number in brackets, e.g. [0041]");
  }
  letter_ = &font_.letters[static_cast<char32_t>(code)];
  *letter_ = {};
  return true;
}

// "C0041": all strokes of a letter that came before.
bool StrokeFontReader::copy_letter(std::string_view line) {
  std::uint32_t code = 0;
  const auto [end, fault] = std::from_chars(line.data() + 1, line.data() + line.size(), code, 16);
  const auto found = fault == std::errc() ? font_.letters.find(static_cast<char32_t>(code)) : font_.letters.end();
  // Fonts that are around name letters that come after, or none. What they say of those is left out, as LibreCAD does.
  if (found == font_.letters.end() || &found->second == letter_) return true;
  for (const std::vector<StrokePoint>& stroke : found->second.strokes) {
    points_ += stroke.size();
    if (points_ > most_font_points) return refuse(line, "the letters of this font are too large", "a smaller font");
    letter_->strokes.push_back(stroke);
  }
  return true;
}

// "x,y" or "x,y,Abulge": the bulge is that of the way to this point.
bool StrokeFontReader::read_point(std::string_view part) {
  const std::string_view all = part;
  const auto wrong = [&] { return refuse(all, "this is not a point of a letter", "x,y or x,y,A with a bulge"); };
  const std::optional<double> x = take_font_number(part);
  if (!x || !part.starts_with(',')) return wrong();
  part.remove_prefix(1);
  const std::optional<double> y = take_font_number(part);
  if (!y) return wrong();
  part = trimmed(part);
  // Fonts that are around leave the comma out here and there, or begin a letter with two brackets.
  if (part.starts_with(",A") || part.starts_with('A')) {
    part.remove_prefix(part.find('A') + 1);
    const std::optional<double> bulge = take_font_number(part);
    if (!bulge) return wrong();
    if (!stroke_.empty()) stroke_.back().bulge = *bulge;
  }
  if (!trimmed(part).empty()) return wrong();
  stroke_.push_back({*x, *y, 0});
  return ++points_ <= most_font_points || refuse(all, "this font has too many points", "a smaller font");
}

bool StrokeFontReader::read_stroke(std::string_view line) {
  stroke_.clear();
  while (!line.empty()) {
    const std::size_t end = std::min(line.find(';'), line.size());
    const std::string_view part = trimmed(line.substr(0, end));
    line.remove_prefix(std::min(end + 1, line.size()));
    if (!part.empty() && !read_point(part)) return false;
  }
  if (!stroke_.empty()) letter_->strokes.push_back(stroke_);
  return true;
}

// The height of capitals is measured; an advance is the width and a space.
void StrokeFontReader::finish(double usual_capital, double letter_space) {
  for (auto& [code, letter] : font_.letters) {
    if (letter.advance > 0) continue;
    double most = 0;
    for (const std::vector<StrokePoint>& stroke : letter.strokes) {
      for (const StrokePoint& point : stroke) most = std::max(most, point.x);
    }
    letter.advance = letter.strokes.empty() ? word_space_ : most + letter_space;
  }
  font_.capital = 0;
  const auto capital = font_.letters.find(U'H');
  if (capital != font_.letters.end()) {
    for (const std::vector<StrokePoint>& stroke : capital->second.strokes) {
      for (const StrokePoint& point : stroke) font_.capital = std::max(font_.capital, point.y);
    }
  }
  if (font_.capital <= usual_capital / 10) font_.capital = usual_capital;
}

StrokeFont StrokeFontReader::read_lff() {
  for (std::string_view line; lines_.next(line);) {
    line_ = line;
    line = trimmed(line);
    if (line.empty()) continue;
    if (line.starts_with('#')) {
      if (!read_header(line)) return {};
    } else if (line.starts_with('[')) {
      if (!begin_letter(line)) return {};
    } else if (letter_ == nullptr) {
      refuse(line, "a stroke before the first letter", "[0041], the code of a letter");
      return {};
    } else if (line.starts_with('C') ? !copy_letter(line) : !read_stroke(line)) {
      return {};
    }
  }
  if (font_.letters.empty()) refuse(line_, "this font has no letters", "lines such as [0041] A, and strokes");
  font_.letters.try_emplace(U' ');
  constexpr double capital_of_lff = 9;
  finish(capital_of_lff, letter_space_);
  return std::move(font_);
}

// A number, how many pairs follow, and the pairs: the left and the right edge, then points. 'R' is 0.
bool StrokeFontReader::read_jhf_letter(std::string_view text, char32_t code) {
  constexpr std::size_t head = 8;
  constexpr double base_line = 9;  // below the middle
  const std::string_view digits = trimmed(text.substr(std::min<std::size_t>(5, text.size()), 3));
  std::size_t pairs = 0;
  const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), pairs);
  const bool is_whole = fault == std::errc() && end == digits.data() + digits.size();
  if (!is_whole || pairs < 1 || text.size() < head + 2 * pairs) {
    return refuse(text, "this is not a letter of a Hershey font", "a number, a count, and as many pairs of characters");
  }
  const auto value = [&](std::size_t i) { return static_cast<double>(static_cast<signed char>(text[head + i]) - 'R'); };
  const double left = value(0);
  StrokeLetter letter{.advance = std::max(1.0, value(1) - left)};
  std::vector<StrokePoint> stroke;
  const auto end_stroke = [&] {
    if (!stroke.empty()) letter.strokes.push_back(std::move(stroke));
    stroke.clear();
  };
  for (std::size_t i = 1; i < pairs; ++i) {
    if (text.substr(head + 2 * i, 2) == " R") {
      end_stroke();
    } else {
      stroke.push_back({value(2 * i) - left, base_line - value(2 * i + 1), 0});
    }
  }
  end_stroke();
  font_.letters.insert_or_assign(code, std::move(letter));
  return true;
}

// Long letters go over several lines.
StrokeFont StrokeFontReader::read_jhf() {
  char32_t code = first_of_ascii;
  std::string whole;
  const auto wanted = [&] {
    std::size_t pairs = 0;
    const std::string_view digits = trimmed(std::string_view(whole).substr(std::min<std::size_t>(5, whole.size()), 3));
    std::from_chars(digits.data(), digits.data() + digits.size(), pairs);
    return 8 + 2 * std::min<std::size_t>(pairs, 999);
  };
  for (std::string_view line; lines_.next(line);) {
    line_ = line;
    if (whole.empty() && trimmed(line).empty()) continue;
    whole += line;
    if (whole.size() < wanted()) continue;
    if (!read_jhf_letter(whole, code++)) return {};
    whole.clear();
  }
  if (!whole.empty() || font_.letters.empty()) {
    refuse(line_, "the last letter of this font is incomplete", "as many pairs of characters as the count gives");
    return {};
  }
  constexpr double capital_of_jhf = 21;
  finish(capital_of_jhf, 0);
  return std::move(font_);
}

// "  699  1JZ", "12345  9MWRFRT": a number in five columns, a count in three.
bool looks_like_jhf(std::string_view text) {
  const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
  if (line.size() < 10) return false;
  const auto is_number = [](std::string_view columns) {
    const std::string_view digits = trimmed(columns);
    return !digits.empty() && columns.ends_with(digits) &&
           std::ranges::all_of(digits, [](char c) { return c >= '0' && c <= '9'; });
  };
  return is_number(line.substr(0, 5)) && is_number(line.substr(5, 3));
}

bool looks_like_lff(std::string_view text) {
  constexpr std::size_t looked_at = 4096;
  text = text.substr(0, looked_at);
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return text.starts_with('#') && (text.find("LibreCAD Font") != std::string_view::npos ||
                                   text.find("LetterSpacing:") != std::string_view::npos);
}

}  // namespace

StrokeFont read_stroke_font(const std::string& name, std::string_view text, Diagnostics& diagnostics) {
  StrokeFontReader reader(name, text, diagnostics);
  return looks_like_lff(text) ? reader.read_lff() : reader.read_jhf();
}

bool looks_like_stroke_font(std::string_view text) {
  return looks_like_lff(text) || looks_like_jhf(text);
}

const StrokeFont& built_in_stroke_font() {
  static const StrokeFont font = [] {
    Diagnostics none;
    return read_stroke_font("simplex", hershey_simplex, none);
  }();
  return font;
}

std::vector<char32_t> characters_of(std::string_view text) {
  constexpr char32_t unknown = 0xFFFD;
  std::vector<char32_t> all;
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i]);
    const std::size_t size = first < 0x80   ? 1
                             : first < 0xC2 ? 0
                             : first < 0xE0 ? 2
                             : first < 0xF0 ? 3
                             : first < 0xF5 ? 4
                                            : 0;
    char32_t code = size == 1 ? first : first & (0x7FU >> size);
    bool is_whole = size > 0 && i + size <= text.size();
    for (std::size_t k = 1; is_whole && k < size; ++k) {
      const auto next = static_cast<unsigned char>(text[i + k]);
      is_whole = (next & 0xC0U) == 0x80U;
      code = code << 6U | (next & 0x3FU);
    }
    all.push_back(is_whole ? code : unknown);
    i += is_whole ? size : 1;
  }
  return all;
}

}  // namespace passo
