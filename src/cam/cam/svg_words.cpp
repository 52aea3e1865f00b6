#include "svg_words.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

#include "passo/base/trimmed.hpp"

namespace passo {
namespace {

std::optional<DxfTransform> one_svg_transform(std::string_view name, const std::array<double, 6>& v,
                                              std::size_t count) {
  const double degree = std::numbers::pi / 180;
  if (name == "matrix" && count == 6) return DxfTransform{v[0], v[2], v[1], v[3], v[4], v[5]};
  if (name == "translate" && (count == 1 || count == 2)) return DxfTransform{.dx = v[0], .dy = v[1]};
  if (name == "translateX" && count == 1) return DxfTransform{.dx = v[0]};
  if (name == "translateY" && count == 1) return DxfTransform{.dy = v[0]};
  if (name == "scaleX" && count == 1) return DxfTransform{.xx = v[0]};
  if (name == "scaleY" && count == 1) return DxfTransform{.yy = v[0]};
  if (name == "scale" && (count == 1 || count == 2)) return DxfTransform{.xx = v[0], .yy = count == 1 ? v[0] : v[1]};
  if (name == "rotate" && (count == 1 || count == 3)) {
    const double c = std::cos(v[0] * degree);
    const double s = std::sin(v[0] * degree);
    return DxfTransform{c, -s, s, c, v[1] - c * v[1] + s * v[2], v[2] - s * v[1] - c * v[2]};
  }
  if (name == "skewX" && count == 1) return DxfTransform{.xy = std::tan(v[0] * degree)};
  if (name == "skewY" && count == 1) return DxfTransform{.yx = std::tan(v[0] * degree)};
  return std::nullopt;
}

}  // namespace

std::optional<DxfTransform> svg_transform(std::string_view text) {
  SvgWords words(text);
  DxfTransform all;
  if (text == "none") return all;
  while (!words.at_end()) {
    const std::string_view name = words.name();
    if (name.empty() || words.peek() != '(') return std::nullopt;
    words.drop();
    std::array<double, 6> values{};
    std::size_t count = 0;
    while (words.peek() != ')') {
      const std::optional<double> value = words.number();
      if (!value || count == values.size()) return std::nullopt;
      values[count++] = *value;
      // CSS has units, the attribute has none.
      const std::string_view unit = words.rest().starts_with("px")    ? "px"
                                    : words.rest().starts_with("deg") ? "deg"
                                                                      : "";
      words.drop(unit.size());
    }
    words.drop();
    const std::optional<DxfTransform> one = one_svg_transform(name, values, count);
    if (!one) return std::nullopt;
    all = all.after(*one);
  }
  return all;
}

std::optional<double> svg_length(std::string_view text, double whole, double inch) {
  SvgWords words(text);
  const std::optional<double> value = words.number();
  if (!value) return std::nullopt;
  const std::array<std::pair<std::string_view, double>, 10> units = {{{"", 1},
                                                                      {"px", 1},
                                                                      {"mm", inch / 25.4},
                                                                      {"cm", inch / 2.54},
                                                                      {"in", inch},
                                                                      {"pt", inch / 72},
                                                                      {"pc", inch / 6},
                                                                      {"Q", inch / 101.6},
                                                                      {"em", 16},
                                                                      {"ex", 8}}};
  const std::string_view unit = words.rest().substr(0, words.rest().find_last_not_of(" \t\r\n") + 1);
  if (unit == "%") return *value / 100 * whole;
  for (const auto& [name, pixels] : units) {
    if (name == unit) return *value * pixels;
  }
  return std::nullopt;
}

std::optional<std::array<double, 2>> svg_transform_origin(std::string_view text, double width, double height,
                                                          double inch) {
  constexpr std::string_view blanks = " \t\r\n\f";
  constexpr std::array<std::pair<std::string_view, double>, 5> sides = {
      {{"left", 0}, {"top", 0}, {"center", 0.5}, {"right", 1}, {"bottom", 1}}};
  std::array<double, 2> origin = {width / 2, height / 2};
  const std::array<double, 2> whole = {width, height};
  std::size_t read = 0;
  for (text = trimmed(text, blanks); !text.empty() && read < origin.size(); text = trimmed(text, blanks)) {
    const std::string_view word = text.substr(0, text.find_first_of(blanks));
    text.remove_prefix(word.size());
    const auto* const side = std::ranges::find(sides, word, &std::pair<std::string_view, double>::first);
    const bool is_upright = word == "top" || word == "bottom";
    const bool is_across = word == "left" || word == "right";
    const std::size_t axis = is_upright ? 1 : is_across ? 0 : read;
    const std::optional<double> length =
        side != sides.end() ? std::optional(side->second * whole.at(axis)) : svg_length(word, whole.at(axis), inch);
    if (!length) return std::nullopt;
    origin.at(axis) = *length;
    ++read;
  }
  return origin;
}

}  // namespace passo
