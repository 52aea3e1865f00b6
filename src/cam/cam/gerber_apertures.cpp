#include "gerber_apertures.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "passo/base/counted.hpp"

namespace passo {
namespace {

constexpr std::size_t most_values = 10'000;
constexpr std::uint32_t highest_code = 999'999'999;

bool is_code_digit(char c) {
  return c >= '0' && c <= '9';
}

}  // namespace

bool GerberApertures::read_definition(Definition& definition) {
  const std::string_view words = findings_.command.words;
  std::size_t at = 2;
  while (at < words.size() && words[at] == ' ') ++at;
  const std::size_t d = at;
  const auto expects = "D, a code from 10 on, a shape and its sizes, e.g. ADD10C,0.5";
  if (at >= words.size() || words[at] != 'D') {
    return findings_.refuse(at, 1, "gerber.bad-aperture", "this does not define an aperture", expects);
  }
  std::uint64_t code = 0;
  for (++at; at < words.size() && is_code_digit(words[at]) && code <= highest_code; ++at) {
    code = code * 10 + static_cast<std::uint64_t>(words[at] - '0');
  }
  if (code < 10 || code > highest_code) {
    return findings_.refuse(d, at - d, "gerber.bad-aperture", fmt::format("D{} is not an aperture", code), expects);
  }
  definition.code = static_cast<std::uint32_t>(code);
  const std::size_t comma = std::min(words.find(',', at), words.size());
  definition.shape = words.substr(at, comma - at);
  while (!definition.shape.empty() && definition.shape.back() == ' ') definition.shape.remove_suffix(1);
  if (definition.shape.empty()) {
    return findings_.refuse(at, 1, "gerber.bad-aperture", "the aperture has no shape", expects);
  }
  definition.values_begin = comma + 1;
  for (at = comma + 1; at < words.size();) {
    const std::size_t end = std::min(words.find_first_of("Xx,", at), words.size());
    const std::string_view text = words.substr(at, end - at);
    std::optional<double> value = read_gerber_decimal(text);
    // "0.03260.326": an X is missing. What comes before the second point is meant, as other readers have it.
    const std::size_t second_point = text.find('.', std::min(text.find('.'), text.size() - 1) + 1);
    if (!value && second_point != std::string_view::npos) {
      value = read_gerber_decimal(text.substr(0, second_point));
      if (value) findings_.note(fmt::format("the size '{}' is read as {:g}", text.substr(0, 60), *value));
    }
    const bool is_last_blank = end == words.size() && text.find_first_not_of(' ') == std::string_view::npos;
    if (is_last_blank) break;
    if (!value || std::abs(*value) > 1e7 || definition.values.size() >= most_values) {
      return findings_.refuse(at, end - at, "gerber.bad-number", fmt::format("'{}' is not a size", text.substr(0, 60)),
                              "a decimal number");
    }
    definition.values.push_back(*value);
    at = end + 1;
  }
  return true;
}

void GerberApertures::define(const std::string& function) {
  Definition definition;
  PlotterAperture aperture;
  if (!read_definition(definition) || !make_shape(definition, aperture)) return;
  aperture.index = layer_.apertures.size();
  GerberAperture& told = layer_.apertures.emplace_back();
  told.code = definition.code;
  told.shape = definition.shape;
  told.function = function;
  measure(aperture.shape, told);
  plotter_.define(definition.code, std::move(aperture));
}

bool GerberApertures::make_shape(const Definition& definition, PlotterAperture& aperture) {
  const auto macro = macros_.find(definition.shape);
  if (macro != macros_.end()) return make_macro(definition, macro->second, aperture);
  if (definition.shape.size() == 1 && std::string_view("CROP").find(definition.shape[0]) != std::string_view::npos) {
    return make_standard(definition, aperture);
  }
  return findings_.refuse(0, 0, "gerber.bad-aperture",
                          fmt::format("there is no shape '{}'", definition.shape.substr(0, 60)),
                          "C, R, O, P, or a macro defined before by %AM...");
}

bool GerberApertures::make_standard(const Definition& definition, PlotterAperture& aperture) {
  const char shape = definition.shape[0];
  std::vector<double> values = definition.values;
  if ((shape == 'R' || shape == 'O') && values.size() == 1) {
    findings_.note(
        fmt::format("aperture D{} has a width but no height; the height is assumed to be the same", definition.code));
    values.push_back(values.front());
  }
  const std::size_t needed = shape == 'C' ? 1 : 2;
  const auto wrong = [&](std::string message, const char* expected) {
    return findings_.refuse(0, 0, "gerber.bad-aperture", std::move(message), expected);
  };
  if (values.size() < needed) {
    return wrong(fmt::format("shape {} has {}", shape, counted(values.size(), "value")),
                 shape == 'C'   ? "a diameter, and optionally a hole diameter"
                 : shape == 'P' ? "a diameter, the number of corners, and optionally an angle and a hole diameter"
                                : "width and height, and optionally a hole diameter");
  }
  if (values[0] < 0 || (shape != 'P' && needed == 2 && values[1] < 0)) {
    return wrong("the size is below 0", "0 or more");
  }
  const double nm = numbers_.nm_per_unit();
  const double first = values[0] * nm;
  if (first / 2 > static_cast<double>(farthest_drawn.count))
    return wrong("the aperture is too large", "a smaller aperture; check the unit");
  if (!plotter_.has_room_for(4 * chords_of_arc(first / 2, std::numbers::pi / 2))) return false;
  switch (shape) {
    case 'C':
      aperture.is_round = true;
      aperture.diameter = first;
      aperture.shape = {{disc_ring({}, first)}};
      break;
    case 'R': aperture.shape = {{rectangle_ring({}, first, values[1] * nm)}}; break;
    case 'O': aperture.shape = {{obround_ring(first, values[1] * nm)}}; break;
    default: {
      const double corners = values[1];
      if (!(corners >= 3 && corners <= 1000))
        return wrong(fmt::format("a polygon of {:g} corners", corners), "3 to 12");
      const double radians = values.size() > 2 ? values[2] * std::numbers::pi / 180 : 0;
      aperture.shape = {{regular_ring({}, first, static_cast<std::size_t>(corners), radians)}};
    }
  }
  return cut_hole(definition, shape == 'C' ? 1 : shape == 'P' ? 3 : 2, aperture);
}

// One value is a round hole, two are an old rectangular hole.
bool GerberApertures::cut_hole(const Definition& definition, std::size_t first, PlotterAperture& aperture) {
  const std::vector<double>& values = definition.values;
  if (values.size() <= first) return true;
  const double nm = numbers_.nm_per_unit();
  const double across = values[first] * nm;
  const double up = values.size() > first + 1 ? values[first + 1] * nm : 0;
  if (across < 0 || up < 0) {
    findings_.note(fmt::format("the hole of aperture D{} has a negative size and is ignored", definition.code));
    return true;
  }
  if (across == 0) return true;
  if (!plotter_.has_room_for(4 * chords_of_arc(across / 2, std::numbers::pi / 2))) return false;
  const DrawnRing hole = up > 0 ? rectangle_ring({}, across, up) : disc_ring({}, across);
  aperture.shape = subtracted(aperture.shape, {{hole}});
  return true;
}

void GerberApertures::begin_macro() {
  const std::string_view words = findings_.command.words;
  std::string name(words.substr(2));
  const std::size_t begin = name.find_first_not_of(' ');
  name.erase(0, std::min(begin, name.size()));
  while (!name.empty() && name.back() == ' ') name.pop_back();
  if (name.empty()) {
    findings_.refuse(0, 0, "gerber.bad-macro", "the macro has no name", "%AMNAME*");
  }
  macro_ = &macros_[name];
  *macro_ = {.name = name, .statements = {}};
}

void GerberApertures::add_statement() {
  GerberCommand place = findings_.command;
  place.words = {};
  macro_->statements.push_back({std::string(findings_.command.words), place});
}

bool GerberApertures::make_macro(const Definition& definition, const GerberMacro& macro, PlotterAperture& aperture) {
  std::vector<GerberMacroFault> faults;
  const GerberMacroLimits limits{
      .nm_per_unit = numbers_.nm_per_unit(),
      .has_room_for = [this](std::size_t points) { return plotter_.has_room_for(points); },
      .can_unite = [this](const std::vector<DrawnRing>& rings) { return plotter_.can_unite(rings); }};
  aperture.shape = shape_of(macro, definition.values, limits, faults);
  for (GerberMacroFault& fault : faults) {
    const std::size_t size = fault.statement->words.size();
    findings_.refuse_in(
        fault.statement->place, fault.at, fault.at < size ? size - fault.at : 1, "gerber.bad-macro",
        fmt::format("{}, in macro {} for aperture D{}", fault.message, macro.name.substr(0, 60), definition.code),
        fault.expected);
  }
  return faults.empty();
}

}  // namespace passo
