// DxfDocument: the layers, blocks and entities of a DXF file as written, before blocks are expanded. Private to cam/.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct DxfNumber {
  int code = 0;
  double value = 0;
};

enum class DxfKind : std::uint8_t {
  point,
  circle,
  arc,
  line,
  lwpolyline,
  polyline,
  vertex,
  seqend,
  ellipse,
  spline,
  insert,
  other
};

// A number of the palette, or red, green and blue.
struct DxfColour {
  std::uint32_t value = 0;
  bool is_true = false;
};
inline constexpr std::uint32_t dxf_colour_of_block = 0;    // the colour of the INSERT
inline constexpr std::uint32_t dxf_colour_of_layer = 256;  // the usual value
inline constexpr DxfColour dxf_usual_colour{7};            // black or white

struct DxfEntity {
  DxfKind kind = DxfKind::other;
  bool is_in_paper = false;
  std::uint32_t layer = 0;  // index into DxfDocument::layers
  std::uint32_t block = 0;  // for an INSERT: index into DxfDocument::blocks
  std::uint32_t line = 0;   // first line of the entity; 0 in a binary file
  std::size_t first = 0;    // index of its first number in DxfDocument::numbers
  std::size_t count = 0;
  DxfColour colour{dxf_colour_of_layer};
  std::uint64_t handle = 0;  // 0: none
};

struct DxfLayer {
  std::string name;
  bool is_on = true;
  DxfColour colour = dxf_usual_colour;
};

struct DxfBlock {
  std::string name;
  bool is_defined = false;
  double base_x = 0;
  double base_y = 0;
  std::vector<DxfEntity> entities = {};
};

struct DxfDocument {
  std::optional<int> insert_units;  // $INSUNITS
  bool has_end = false;             // whether EOF was read
  std::vector<DxfLayer> layers;
  std::vector<DxfBlock> blocks;
  std::vector<DxfEntity> entities;
  std::vector<DxfNumber> numbers;               // the numbers of all entities
  std::map<std::string, std::size_t> left_out;  // names of unsupported entities and how often each occurs

  std::span<const DxfNumber> numbers_of(const DxfEntity& entity) const {
    return std::span(numbers).subspan(entity.first, entity.count);
  }
  // Returns the first number with this group code, or `otherwise`.
  double number(const DxfEntity& entity, int code, double otherwise) const;
};

// Reports errors in `diagnostics`; the document then contains what was read before the error.
DxfDocument read_dxf_document(const std::string& name, std::string_view text, Diagnostics& diagnostics);

}  // namespace passo
