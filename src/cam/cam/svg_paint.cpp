#include "svg_paint.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <utility>

#include "svg_style.hpp"
#include "svg_words.hpp"
#include <fmt/format.h>

#include "passo/base/trimmed.hpp"

namespace passo {
namespace {

constexpr std::string_view paint_blanks = " \t\r\n\f";

constexpr std::array<std::pair<std::string_view, std::string_view>, 21> named_colours = {
    {{"black", "#000000"},   {"white", "#ffffff"},  {"red", "#ff0000"},  {"lime", "#00ff00"},   {"green", "#008000"},
     {"blue", "#0000ff"},    {"yellow", "#ffff00"}, {"cyan", "#00ffff"}, {"aqua", "#00ffff"},   {"magenta", "#ff00ff"},
     {"fuchsia", "#ff00ff"}, {"orange", "#ffa500"}, {"gray", "#808080"}, {"grey", "#808080"},   {"silver", "#c0c0c0"},
     {"maroon", "#800000"},  {"olive", "#808000"},  {"navy", "#000080"}, {"purple", "#800080"}, {"teal", "#008080"},
     {"brown", "#a52a2a"}}};

bool are_digits(std::string_view digits) {
  return std::ranges::all_of(digits, [](unsigned char c) { return std::isxdigit(c) != 0; });
}

// rgb(255, 0, 0) or rgb(100%, 0%, 0%).
std::optional<std::string> rgb_colour(std::string_view text) {
  if (!text.starts_with("rgb(") || !text.ends_with(")")) return std::nullopt;
  std::string inside(text.substr(4, text.size() - 5));
  const double scale = inside.find('%') != std::string::npos ? 2.55 : 1;
  std::ranges::replace_if(
      inside, [](char c) { return c == ',' || c == '%'; }, ' ');
  SvgWords words(inside);
  std::string colour = "#";
  for (int i = 0; i < 3; ++i) {
    const std::optional<double> value = words.number();
    if (!value) return std::nullopt;
    colour += fmt::format("{:02x}", static_cast<int>(std::lround(std::clamp(*value * scale, 0.0, 255.0))));
  }
  return colour;
}

bool is_no_paint(std::string_view paint) {
  return paint.empty() || is_css_word(paint, "none") || is_css_word(paint, "transparent");
}

}  // namespace

std::string svg_colour(std::string_view text) {
  std::string colour(trimmed(text, paint_blanks));
  std::ranges::transform(colour, colour.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::size_t short_form = 4;
  if (colour.size() == short_form && colour.front() == '#' && are_digits(std::string_view(colour).substr(1))) {
    return {'#', colour[1], colour[1], colour[2], colour[2], colour[3], colour[3]};
  }
  const auto* const named =
      std::ranges::find(named_colours, colour, &std::pair<std::string_view, std::string_view>::first);
  if (named != named_colours.end()) return std::string(named->second);
  return rgb_colour(colour).value_or(colour);
}

std::string drawn_colour(std::string_view stroke, std::string_view fill) {
  if (!is_no_paint(stroke)) return svg_colour(stroke);
  return svg_colour(fill.empty() ? "black" : fill);
}

}  // namespace passo
