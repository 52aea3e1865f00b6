// SvgDocument: the elements of an SVG text as a tree. Private to cam/.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct SvgElement {
  std::string name = {};  // element name without the namespace prefix
  std::vector<std::pair<std::string, std::string>> attributes = {};
  std::vector<std::uint32_t> children = {};  // indices of the child elements
  std::uint32_t parent = 0;
  std::uint32_t line = 0;
  // The properties from style sheets and the style attribute; see SvgStyleSheet. Unused unless a rule matched
  // (`is_styled`).
  std::vector<std::pair<std::string, std::string>> style = {};
  bool is_styled = false;

  // Returns the value of an attribute; empty if it is missing.
  std::string_view attribute(std::string_view name) const;
  // Returns the value of a property from style sheets and `style`, otherwise from the attribute of that name.
  std::string_view property(std::string_view name) const;
};

struct SvgDocument {
  std::vector<SvgElement> elements = {};  // the first is the root; empty if nothing was read
  std::unordered_map<std::string, std::uint32_t> ids = {};
  std::string inkscape_version = {};  // of the program that wrote the file, e.g. "0.48.4 r9939"
  std::size_t skipped_rules = 0;      // rules of style sheets that are not supported, and sheets in other files
};

// Applies the style sheets of the document. Reports errors "svg.…" in `diagnostics`; the document is then empty.
SvgDocument read_svg_document(const std::string& name, std::string_view text, Diagnostics& diagnostics);

}  // namespace passo
