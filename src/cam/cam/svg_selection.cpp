#include "svg_selection.hpp"

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

void add_names(const SvgElement& element, std::string& names) {
  constexpr std::size_t longest = 1000;
  for (const char* const attribute : {"id", "inkscape:label"}) {
    std::string name(element.attribute(attribute));
    if (name.empty() || names.size() + name.size() > longest) continue;
    std::ranges::replace(name, '\n', ' ');
    names += "\n" + name;
  }
}

std::string colour_of(const SvgSelection::Paint& paint) {
  const std::string_view area = paint.fill.empty() ? "black" : paint.fill;
  return svg_colour(is_no_paint(paint.stroke) ? area : paint.stroke);
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

SvgSelection::SvgSelection(const SvgOptions& options) : options_(options) {
  for (const std::string& color : options.colors) colours_.push_back(svg_colour(color));
}

// Colours are inherited, and a group's name is that of all in it.
void SvgSelection::enter(const SvgElement& element, Paint& paint) {
  const auto inherit = [&](const char* property, std::string_view& value) {
    const std::string_view own = element.property(property);
    if (!own.empty() && !is_css_word(own, "inherit")) value = own;
  };
  if (!colours_.empty() || options_.tells_shapes) {
    inherit("stroke", paint.stroke);
    inherit("fill", paint.fill);
  }
  if (options_.tells_shapes) add_names(element, paint.names);
  for (const std::string& name : options_.names) {
    if (element.attribute("id") != name && element.attribute("inkscape:label") != name) continue;
    paint.is_named = true;
    found_.insert(name);
  }
}

SvgSpace told(SvgSpace space, const SvgSelection::Paint& paint, DrawingBuilder& builder) {
  const std::string layer = builder.drawing().layers[space.layer];
  space.layer = builder.layer(fmt::format("{}\n{}{}", layer, colour_of(paint), paint.names));
  return space;
}

bool SvgSelection::takes(const Paint& paint) {
  if (!options_.names.empty() && !paint.is_named) return false;
  if (colours_.empty()) return true;
  const std::string colour = colour_of(paint);
  if (std::ranges::find(colours_, colour) == colours_.end()) return false;
  found_.insert(colour);
  return true;
}

std::vector<std::string> SvgSelection::missing() const {
  std::vector<std::string> notes;
  for (const std::string& color : options_.colors) {
    if (found_.contains(svg_colour(color))) continue;
    notes.push_back(fmt::format("nothing that is read has the colour '{}'", color));
  }
  for (const std::string& name : options_.names) {
    if (!found_.contains(name)) notes.push_back(fmt::format("nothing has the id or label '{}'", name));
  }
  return notes;
}

}  // namespace passo
