// SourceNode: the configuration file of another controller as a tree, whatever its format was.
//
// The readers of the formats make it: parse_settings_dump() and parse_ini() of this module, yaml-cpp and expat in
// controller_file, and in a browser JavaScript's own readers of YAML and XML. import_machine() maps it to a machine
// file. A tree has at most `most_source_nodes` nodes and is at most `deepest_source_node` deep.
//
//   YAML   a map's keys are children, in their order; an element of a sequence is a child without a name
//   XML    an element is a node, its elements are children; the root node is the outermost element. No attributes
//   ini    a section is a child of the root, its keys are its children; a key that appears twice is there twice
//   $$     a setting is a child of the root with its name: "$100"
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace passo {

inline constexpr std::size_t most_source_nodes = 50'000;
inline constexpr std::size_t deepest_source_node = 32;
inline constexpr std::size_t most_source_bytes = std::size_t{1} << 20;

struct SourceNode {
  std::string name;
  std::string text;  // of a node without children; without blanks and quotes around it
  std::vector<SourceNode> children;
  // Where the text is in the file, or the name if there is no text; counted from 1, columns in bytes. 0: unknown.
  std::uint32_t line = 0;
  std::uint32_t column = 0;

  // The first child with this name, or null.
  const SourceNode* child(std::string_view wanted) const;
};

}  // namespace passo
