#include "drawing_builder.hpp"

#include <fmt/format.h>

namespace passo {

std::uint32_t DrawingBuilder::layer(std::string_view name) {
  const auto [entry, is_new] =
      layers_.try_emplace(std::string(name), static_cast<std::uint32_t>(drawing_.layers.size()));
  if (is_new) drawing_.layers.emplace_back(name);
  return entry->second;
}

void DrawingBuilder::add_hole(const DrawnHole& hole) {
  if (!is_full_) drawing_.holes.push_back(hole);
}

void DrawingBuilder::add_path(DrawnPath path) {
  if (!is_full_ && path.points.size() >= 2) drawing_.paths.push_back(std::move(path));
}

std::optional<Nanometres> DrawingBuilder::length(Mm value, const SourceLocation& place, std::string_view text) {
  if (std::abs(value.value()) <= to_mm(farthest_drawn).value()) return to_nanometres(value);  // false for a NaN
  refuse("drawing.too-far", place, text, fmt::format("a length of {:g} mm is too large for a drawing", value.value()),
         fmt::format("at most {:g} mm; check the unit", to_mm(farthest_drawn).value()));
  return std::nullopt;
}

std::optional<DrawnPoint> DrawingBuilder::point(Mm x, Mm y, const SourceLocation& place, std::string_view text) {
  const auto across = length(x, place, text);
  if (!across) return std::nullopt;
  const auto up = length(y, place, text);
  if (!up) return std::nullopt;
  return DrawnPoint{*across, *up};
}

bool DrawingBuilder::has_room_for(std::size_t points, const SourceLocation& place, std::string_view text) {
  if (is_full_) return false;
  if (points <= most_drawn - points_) {
    points_ += points;
    return true;
  }
  is_full_ = true;
  refuse("drawing.too-large", place, text, fmt::format("the drawing has more than {} points", most_drawn),
         "a smaller drawing, or fewer repeats");
  return false;
}

void DrawingBuilder::refuse(std::string code, const SourceLocation& place, std::string_view text, std::string message,
                            std::string expected) {
  diagnostics_.add({.code = std::move(code),
                    .file = drawing_.file,
                    .place = place,
                    .message = std::move(message),
                    .expected = std::move(expected),
                    .text = std::string(text)});
}

}  // namespace passo
