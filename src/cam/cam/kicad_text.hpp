// KicadText: the text of a KiCad board, one item after the other. Private to cam/.
//
// The file is a list of lists: (kicad_pcb (version 20211014) (segment (start 1 2) (end 3 4) (width 0.2))). A list
// begins with its name; words and lists follow. An item is a list in the outermost one. Only one item is held at a
// time, so memory is that of the text and of its largest item.
//
// Lists nest 64 deep, and an item has at most 4 million words and lists. Other texts are refused, with line and column.
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
  std::string_view word = {};  // of a list its name; of a text what is between its quotes
  std::uint32_t first = 0;     // what follows the name; 0: nothing
  std::uint32_t next = 0;      // what follows in the list around this; 0: nothing
  std::uint32_t offset = 0;    // of the file
  bool is_list = false;
};

// A word or a list in the nodes of a text. Empty: there is none. It is good until the next item is read.
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

  // The first list of this name in this list.
  KicadItem find(std::string_view name) const {
    for (KicadItem item = first(); item; item = item.next()) {
      if (item.is(name)) return item;
    }
    return {};
  }
  // The word at this place among the list's words, from 0. Empty: there are fewer.
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
  // Whether the word, or a list of this name, is in the list.
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

  // The outermost list's name is read. False, and reported: the text does not begin with this name.
  bool begins_with(std::string_view name);
  // The next item. Empty: there is none, or an error is reported.
  KicadItem next();

  // The number at this place among the list's words, in nanometres. 0, and reported: there is none, or it is farther
  // from zero than a drawing may be.
  Nanometres length(KicadItem list, std::size_t place);
  // Degrees and shares.
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
  std::vector<KicadNode> nodes_;  // of the item; the first is none
  std::size_t at_ = 0;
  std::size_t counted_ = 0;  // up to here,
  std::uint32_t lines_ = 1;  // this many lines begin
  bool is_over_ = false;
};

}  // namespace passo
