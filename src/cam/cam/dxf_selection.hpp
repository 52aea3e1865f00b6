// DxfSelection: selects entities of a DXF drawing by their colours and names. Private to cam/.
//
// The colour is the one that is seen: the entity's own, that of its layer, or in a block that of the INSERT. A wanted
// colour is a number of the palette ("30"), or a colour as in SVG ("red", "#f00"): a true colour, or one of the first
// nine of the palette, whose colours all programs agree on. Number 7 is black as well as white.
// A name is that of a layer, of a block, or the handle of an entity. An INSERT gives its names to all in it.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "dxf_document.hpp"

#include "passo/cam/dxf.hpp"

namespace passo {

class DxfSelection {
 public:
  DxfSelection(const DxfDocument& document, const DxfOptions& options);

  // What an entity has of the INSERT that places it.
  struct Around {
    DxfColour colour = dxf_usual_colour;
    bool is_named = false;
    std::string names = {};  // with DxfOptions::tells_shapes, each after a line break
  };
  // `layer`: of the entity. Returns what an INSERT hands on to its block.
  Around inside(const DxfEntity& insert, std::uint32_t layer, const Around& around);
  bool takes(const DxfEntity& entity, std::uint32_t layer, const Around& around);
  // What DxfOptions::tells_shapes adds to the name of a layer.
  std::string told(const DxfEntity& entity, std::uint32_t layer, const Around& around) const;
  // Returns a note for each colour and name that was not found.
  std::vector<std::string> missing() const;

 private:
  DxfColour colour_of(const DxfEntity& entity, std::uint32_t layer, const Around& around) const;
  bool is_named(const std::string& name);
  bool has_name(const DxfEntity& entity, std::uint32_t layer);

  const DxfDocument& document_;
  const DxfOptions& options_;
  std::set<std::string> colours_;         // "30" or "#rrggbb"
  std::set<std::string> names_;           // in capitals
  std::vector<std::string> layer_names_;  // in capitals, of the document's layers
  std::set<std::string> found_;
};

}  // namespace passo
