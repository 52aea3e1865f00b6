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
  std::uint32_t line = 0;

  // Returns the value of an attribute; empty if it is missing.
  std::string_view attribute(std::string_view name) const;
  // Returns the value of a property from `style`, otherwise from the attribute of that name.
  std::string_view property(std::string_view name) const;
};

struct SvgDocument {
  std::vector<SvgElement> elements = {};  // the first is the root; empty if nothing was read
  std::unordered_map<std::string, std::uint32_t> ids = {};
};

// Reports errors "svg.…" in `diagnostics`; the document is then empty.
SvgDocument read_svg_document(const std::string& name, std::string_view text, Diagnostics& diagnostics);

}  // namespace passo
