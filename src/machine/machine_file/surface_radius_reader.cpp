#include "surface_radius_reader.hpp"

#include <fmt/format.h>

#include "passo/toml/toml_sentences.hpp"

namespace passo {
namespace {

constexpr NumberKey radius_key{"radius_mm", 0.01, 1e5, "20"};
constexpr std::string_view radius_of_tool = "tool";

}  // namespace

// The tool's distance from the axis is its Z, so it is known of A and B only.
std::optional<Mm> read_surface_radius(TableReader& reader, Axis axis) {
  if (!reader.has_text(radius_key.name)) {
    const auto radius = reader.number(radius_key, Need::optional);
    return radius ? std::optional(Mm(*radius)) : std::nullopt;
  }
  const auto word = reader.text(radius_key.name, radius_of_tool, Need::optional);
  if (word == radius_of_tool && axis != Axis::c) return Mm(0);
  reader.error(
      "machine.radius", radius_key.name,
      toml_says::key_is.with({{"key", reader.full_name(radius_key.name)}, {"value", fmt::format("\"{}\"", *word)}}),
      axis == Axis::c ? "a radius in millimetres" : fmt::format("a radius in millimetres, or \"{}\"", radius_of_tool));
  return std::nullopt;
}

}  // namespace passo
