// KicadText: reads the text of a KiCad board item by item. Private to cam/.
//
// The file is a list of lists: (kicad_pcb (version 20211014) (segment (start 1 2) (end 3 4) (width 0.2))). A list
// begins with its name; words and lists follow. An item is a direct child of the outermost list. Only one item is held
// at a time, so the memory is that of the text and of its largest item.
//
// Lists may be nested 64 deep, and an item may contain 4 million words and lists. Texts that exceed this are refused,
// with line and column.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "passo/cam/drawing.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

// A word or a list.
struct KicadNode {
  std::string_view word = {};  // the name of a list; the text between the quotes of a string
  std::uint32_t first = 0;     // the first child after the name; 0: none
  std::uint32_t next = 0;      // the next sibling; 0: none
  std::uint32_t offset = 0;    // offset in the file
  bool is_list = false;
};

// A word or a list in the nodes of a text; may be empty. It is valid until the next item is read.
class KicadItem {
 public:
  KicadItem() = default;
  KicadItem(const std::vector<KicadNode>& nodes, std::uint32_t index) : nodes_(&nodes), index_(index) {}

  explicit operator bool() const { return nodes_ != nullptr; }
  const KicadNode& node() const { return (*nodes_)[index_]; }
  std::string_view name() const { return node().word; }
  bool is(std::string_view name) const { return node().is_list && node().word == name; }
  KicadItem first() const { return at(node().first); }
  KicadItem next() const { return at(node().next); }

  // Returns the first child list of this name.
  KicadItem find(std::string_view name) const {
    for (KicadItem item = first(); item; item = item.next()) {
      if (item.is(name)) return item;
    }
    return {};
  }
  // Returns the word with this index among the list's words, from 0. Empty if there are fewer.
  KicadItem word(std::size_t place) const {
    for (KicadItem item = first(); item; item = item.next()) {
      if (!item.node().is_list && place-- == 0) return item;
    }
    return {};
  }
  std::string_view text(std::size_t place) const {
    const KicadItem found = word(place);
    return found ? found.name() : std::string_view();
  }
  // Returns whether the list contains this word or a list of this name.
  bool has(std::string_view word) const {
    for (KicadItem item = first(); item; item = item.next()) {
      if (item.name() == word) return true;
    }
    return false;
  }

 private:
  KicadItem at(std::uint32_t index) const { return index == 0 ? KicadItem() : KicadItem(*nodes_, index); }

  const std::vector<KicadNode>* nodes_ = nullptr;
  std::uint32_t index_ = 0;
};

class KicadText {
 public:
  KicadText(const std::string& file, std::string_view text, Diagnostics& diagnostics)
      : file_(file), text_(text), diagnostics_(diagnostics) {}

  // Reads the name of the outermost list. Reports an error and returns false if it is a different name.
  bool begins_with(std::string_view name);
  // Returns the next item. Empty at the end and after a reported error.
  KicadItem next();

  // Returns the number with this index among the list's words, in nanometres. Reports an error and returns 0 if it is
  // missing or exceeds the limit of a drawing.
  Nanometres length(KicadItem list, std::size_t place);
  // Does the same for degrees and ratios.
  double number(KicadItem list, std::size_t place);
  std::uint32_t line_of(KicadItem item);
  void refuse(KicadItem item, std::string code, std::string message, std::string expected) {
    refuse_at(item.node().offset, item.name().size(), std::move(code), std::move(message), std::move(expected));
  }
  bool full() const { return is_over_ || diagnostics_.full(); }

 private:
  void refuse_at(std::size_t offset, std::size_t length, std::string code, std::string message, std::string expected);
  void skip_blanks();
  bool read_word(std::string_view& word);
  std::uint32_t add(const KicadNode& node, std::vector<std::uint32_t>& parents, std::uint32_t& last);

  const std::string& file_;
  std::string_view text_;
  Diagnostics& diagnostics_;
  std::vector<KicadNode> nodes_;  // nodes of the item; the first is a null node
  std::size_t at_ = 0;
  std::size_t counted_ = 0;  // offset up to which lines are counted,
  std::uint32_t lines_ = 1;  // and the number of lines up to there
  bool is_over_ = false;
};

}  // namespace passo
