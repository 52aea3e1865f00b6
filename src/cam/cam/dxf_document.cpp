#include "dxf_document.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "dxf_groups.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

constexpr std::size_t most_numbers = 24'000'000;
constexpr std::size_t most_entities = 4'000'000;

constexpr std::pair<std::string_view, DxfKind> kinds[] = {
    {"POINT", DxfKind::point},   {"CIRCLE", DxfKind::circle},         {"ARC", DxfKind::arc},
    {"LINE", DxfKind::line},     {"LWPOLYLINE", DxfKind::lwpolyline}, {"POLYLINE", DxfKind::polyline},
    {"VERTEX", DxfKind::vertex}, {"SEQEND", DxfKind::seqend},         {"ELLIPSE", DxfKind::ellipse},
    {"SPLINE", DxfKind::spline}, {"INSERT", DxfKind::insert}};

// Names of layers and blocks are the same in capitals and small letters.
std::string in_capitals(std::string_view name) {
  std::string text(name);
  std::ranges::transform(text, text.begin(),
                         [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; });
  return text;
}

// Group 62 is a number of the palette, which is negative if a layer is off; group 420 is a true colour, and counts
// more.
void take_colour(const DxfGroup& group, DxfColour& colour) {
  constexpr double most_of_palette = 256;
  constexpr double most_true = 0xffffff;
  const double value = std::abs(group.number);
  if (group.code == 420 && value <= most_true) colour = {static_cast<std::uint32_t>(value), true};
  if (group.code == 62 && value <= most_of_palette && !colour.is_true) colour.value = static_cast<std::uint32_t>(value);
}

// 0: not a handle.
std::uint64_t handle_in(std::string_view text) {
  std::uint64_t handle = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), handle, 16);
  return error == std::errc() && end == text.data() + text.size() ? handle : 0;
}

bool is_geometry(int code) {
  return (code >= 10 && code <= 59) || (code >= 70 && code <= 75) || code == 210 || code == 220 || code == 230;
}

class DxfDocumentReader {
 public:
  DxfDocumentReader(const std::string& name, std::string_view text, Diagnostics& diagnostics)
      : groups_(name, text, diagnostics) {}

  DxfDocument read() {
    bool goes_on = next();
    while (goes_on) {
      if (group_.is(0, "EOF")) {
        document_.has_end = true;
        break;
      }
      if (!group_.is(0, "SECTION")) {
        goes_on = next();
        continue;
      }
      if (!next()) break;
      const std::string section(group_.code == 2 ? group_.text : "");
      goes_on = read_section(section);
    }
    finish();
    return std::move(document_);
  }

 private:
  bool next() { return !is_full_ && groups_.next(group_); }
  bool read_section(const std::string& section);
  bool read_header();
  bool read_tables();
  bool read_blocks();
  bool read_block();
  // Reads the entity that begins with the current group; the current group is then the first one after it.
  bool read_entity(std::vector<DxfEntity>& entities);
  std::uint32_t layer(std::string_view name);
  std::uint32_t block(std::string_view name);
  void finish();

  DxfGroups groups_;
  DxfGroup group_;
  DxfDocument document_;
  std::unordered_map<std::string, std::uint32_t> layers_;
  std::unordered_map<std::string, std::uint32_t> blocks_;
  std::size_t entities_ = 0;
  bool is_full_ = false;
  bool has_entities_ = false;
};

bool DxfDocumentReader::read_section(const std::string& section) {
  if (section == "HEADER") return read_header();
  if (section == "TABLES") return read_tables();
  if (section == "BLOCKS") return read_blocks();
  const bool is_wanted = section == "ENTITIES";
  has_entities_ = has_entities_ || is_wanted;
  bool goes_on = next();
  while (goes_on && !group_.is(0, "ENDSEC") && !group_.is(0, "EOF")) {
    goes_on = is_wanted && group_.code == 0 ? read_entity(document_.entities) : next();
  }
  return goes_on;
}

bool DxfDocumentReader::read_header() {
  bool is_units = false;
  bool goes_on = next();
  while (goes_on && group_.code != 0) {
    if (group_.code == 9) is_units = group_.text == "$INSUNITS";
    if (is_units && group_.code == 70) document_.insert_units = static_cast<int>(group_.number);
    goes_on = next();
  }
  return goes_on;
}

bool DxfDocumentReader::read_tables() {
  bool is_layer = false;
  std::uint32_t current = 0;
  bool is_named = false;
  bool goes_on = next();
  while (goes_on && !group_.is(0, "ENDSEC") && !group_.is(0, "EOF")) {
    if (group_.code == 0) {
      is_layer = group_.text == "LAYER";
      is_named = false;
    } else if (is_layer && group_.code == 2) {
      current = layer(group_.text);
      is_named = true;
    } else if (is_layer && is_named) {
      DxfLayer& named = document_.layers[current];
      take_colour(group_, named.colour);
      if (group_.code == 62 && group_.number < 0) named.is_on = false;                           // off
      if (group_.code == 70 && (static_cast<int>(group_.number) & 1) != 0) named.is_on = false;  // frozen
    }
    goes_on = next();
  }
  return goes_on;
}

bool DxfDocumentReader::read_blocks() {
  bool goes_on = next();
  while (goes_on && !group_.is(0, "ENDSEC") && !group_.is(0, "EOF")) {
    goes_on = group_.is(0, "BLOCK") ? read_block() : next();
  }
  return goes_on;
}

bool DxfDocumentReader::read_block() {
  DxfBlock read;
  bool goes_on = next();
  while (goes_on && group_.code != 0) {
    if (group_.code == 2) read.name = group_.text;
    if (group_.code == 10) read.base_x = group_.number;
    if (group_.code == 20) read.base_y = group_.number;
    goes_on = next();
  }
  while (goes_on && !group_.is(0, "ENDBLK") && !group_.is(0, "ENDSEC") && !group_.is(0, "EOF")) {
    goes_on = group_.code == 0 ? read_entity(read.entities) : next();
  }
  read.is_defined = true;
  const std::uint32_t index = block(read.name);
  if (!document_.blocks[index].is_defined) document_.blocks[index] = std::move(read);
  return goes_on;
}

bool DxfDocumentReader::read_entity(std::vector<DxfEntity>& entities) {
  const auto found = std::ranges::find(kinds, group_.text, &std::pair<std::string_view, DxfKind>::first);
  DxfEntity entity{.kind = found == std::end(kinds) ? DxfKind::other : found->second,
                   .line = group_.line,
                   .first = document_.numbers.size()};
  constexpr std::size_t longest_name = 40;
  constexpr std::size_t most_names = 100;
  if (entity.kind == DxfKind::other && document_.left_out.size() < most_names) {
    ++document_.left_out[std::string(group_.text.substr(0, longest_name))];
  }
  if (++entities_ > most_entities || document_.numbers.size() > most_numbers) {
    is_full_ = true;
    groups_.refuse(group_.line, "drawing.too-large", "the drawing is too large", "a smaller drawing");
    return false;
  }
  std::uint32_t layer_of = layer("0");
  bool goes_on = next();
  for (; goes_on && group_.code != 0; goes_on = next()) {
    if (group_.code == 8) layer_of = layer(group_.text);
    if (group_.code == 2 && entity.kind == DxfKind::insert) entity.block = block(group_.text);
    if (group_.code == 5) entity.handle = handle_in(group_.text);
    take_colour(group_, entity.colour);
    if (group_.code == 67) entity.is_in_paper = group_.number == 1;
    if (entity.kind != DxfKind::other && is_geometry(group_.code) && document_.numbers.size() <= most_numbers) {
      document_.numbers.push_back({group_.code, group_.number});
    }
  }
  entity.layer = layer_of;
  entity.count = document_.numbers.size() - entity.first;
  if (entity.kind != DxfKind::other) entities.push_back(entity);
  return goes_on;
}

std::uint32_t DxfDocumentReader::layer(std::string_view name) {
  const auto [entry, is_new] =
      layers_.try_emplace(in_capitals(name), static_cast<std::uint32_t>(document_.layers.size()));
  if (is_new) document_.layers.push_back({std::string(name)});
  return entry->second;
}

std::uint32_t DxfDocumentReader::block(std::string_view name) {
  const auto [entry, is_new] =
      blocks_.try_emplace(in_capitals(name), static_cast<std::uint32_t>(document_.blocks.size()));
  if (is_new) document_.blocks.push_back({.name = std::string(name)});
  return entry->second;
}

void DxfDocumentReader::finish() {
  if (groups_.has_failed() || is_full_ || has_entities_) return;
  groups_.refuse(1, "dxf.no-entities", "the file has no section ENTITIES", "a DXF drawing");
}

}  // namespace

double DxfDocument::number(const DxfEntity& entity, int code, double otherwise) const {
  const auto all = numbers_of(entity);
  const auto found = std::ranges::find(all, code, &DxfNumber::code);
  return found == all.end() ? otherwise : found->value;
}

DxfDocument read_dxf_document(const std::string& name, std::string_view text, Diagnostics& diagnostics) {
  return DxfDocumentReader(name, text, diagnostics).read();
}

}  // namespace passo
