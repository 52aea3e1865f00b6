#include "dxf_selection.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "svg_selection.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

constexpr std::array<std::string_view, 10> first_of_palette = {"",        "#ff0000", "#ffff00", "#00ff00", "#00ffff",
                                                               "#0000ff", "#ff00ff", "#ffffff", "#808080", "#c0c0c0"};
constexpr std::string_view black = "#000000";
constexpr std::uint32_t black_or_white = 7;

std::string capitals_of(std::string_view name) {
  std::string text(name);
  std::ranges::transform(text, text.begin(),
                         [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  return text;
}

// The ways to name a colour of a drawing.
std::vector<std::string> words_of_colour(DxfColour colour) {
  if (colour.is_true) return {fmt::format("#{:06x}", colour.value)};
  std::vector<std::string> words{fmt::format("{}", colour.value)};
  if (colour.value > 0 && colour.value < first_of_palette.size()) words.emplace_back(first_of_palette[colour.value]);
  if (colour.value == black_or_white) words.emplace_back(black);
  return words;
}

// "#ff0000" rather than the number 1.
std::string usual_word_of(DxfColour colour) {
  const std::vector<std::string> words = words_of_colour(colour);
  return words.size() > 1 ? words[1] : words.front();
}

std::string handle_words(const DxfEntity& entity) {
  return entity.handle == 0 ? "" : fmt::format("\n{:X}", entity.handle);
}

}  // namespace

DxfSelection::DxfSelection(const DxfDocument& document, const DxfOptions& options)
    : document_(document), options_(options) {
  for (const std::string& color : options.colors) colours_.insert(svg_colour(color));
  for (const std::string& name : options.names) names_.insert(capitals_of(name));
  if (names_.empty()) return;
  for (const DxfLayer& layer : document.layers) layer_names_.push_back(capitals_of(layer.name));
}

DxfColour DxfSelection::colour_of(const DxfEntity& entity, std::uint32_t layer, const Around& around) const {
  if (entity.colour.is_true) return entity.colour;
  if (entity.colour.value == dxf_colour_of_block) return around.colour;
  return entity.colour.value == dxf_colour_of_layer ? document_.layers[layer].colour : entity.colour;
}

bool DxfSelection::is_named(const std::string& name) {
  if (!names_.contains(name)) return false;
  found_.insert(name);
  return true;
}

bool DxfSelection::has_name(const DxfEntity& entity, std::uint32_t layer) {
  const bool by_layer = is_named(layer_names_[layer]);
  return (entity.handle != 0 && is_named(fmt::format("{:X}", entity.handle))) || by_layer;
}

DxfSelection::Around DxfSelection::inside(const DxfEntity& insert, std::uint32_t layer, const Around& around) {
  Around within{colour_of(insert, layer, around), around.is_named};
  constexpr std::size_t longest = 1000;
  if (options_.tells_shapes && around.names.size() < longest) {
    const bool has_block = insert.block < document_.blocks.size();
    std::string block = has_block ? document_.blocks[insert.block].name.substr(0, longest) : "";
    std::ranges::replace(block, '\n', ' ');
    within.names = around.names + handle_words(insert) + (has_block ? "\n" + block : "");
  }
  if (names_.empty()) return within;
  const bool by_block =
      insert.block < document_.blocks.size() && is_named(capitals_of(document_.blocks[insert.block].name));
  within.is_named = has_name(insert, layer) || by_block || around.is_named;
  return within;
}

bool DxfSelection::takes(const DxfEntity& entity, std::uint32_t layer, const Around& around) {
  if (!names_.empty()) {
    const bool own = has_name(entity, layer);
    if (!own && !around.is_named) return false;
  }
  if (colours_.empty()) return true;
  for (const std::string& words : words_of_colour(colour_of(entity, layer, around))) {
    if (!colours_.contains(words)) continue;
    found_.insert(words);
    return true;
  }
  return false;
}

std::string DxfSelection::told(const DxfEntity& entity, std::uint32_t layer, const Around& around) const {
  return fmt::format("\n{}{}{}", usual_word_of(colour_of(entity, layer, around)), handle_words(entity), around.names);
}

std::vector<std::string> DxfSelection::missing() const {
  std::vector<std::string> notes;
  for (const std::string& color : options_.colors) {
    if (found_.contains(svg_colour(color))) continue;
    notes.push_back(fmt::format("nothing that is read has the colour '{}'", color));
  }
  for (const std::string& name : options_.names) {
    if (!found_.contains(capitals_of(name))) notes.push_back(fmt::format("no layer, block or handle is '{}'", name));
  }
  return notes;
}

}  // namespace passo
