// KeptBlocks: a cache of parsed blocks, so that the body of a loop or subroutine is parsed only once.
//
// The line number determines the slot of its block. The next line with the same slot replaces the block. A body with at
// most as many lines as there are slots is therefore cached completely. Memory is bounded: about 1 KiB for each slot in
// use, at most 10 MiB in total. A slot keeps its capacity, so lines that share a slot soon need no more allocations.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "passo/gcode/block.hpp"
#include "passo/gcode/program_reader.hpp"

namespace passo {

struct KeptBlock {
  std::uint32_t file = 0;  // its number among the files of the program
  ReaderPosition at{.offset = 0, .line = 0};
  ReaderPosition after;  // the line after it
  std::string text;      // the text of the line; the block's views point into it
  Block block;
};

class KeptBlocks {
 public:
  static constexpr std::size_t places = 512;  // a power of two
  static constexpr std::size_t longest_text = 256;

  // Returns the cached block of the line at this position, or null.
  KeptBlock* find(std::uint32_t file, ReaderPosition at) {
    if (places_.empty()) return nullptr;
    KeptBlock& there = place(file, at.line);
    return there.at.line == at.line && there.at.offset == at.offset && there.file == file ? &there : nullptr;
  }
  // Returns the slot into which that line's block is to be parsed. Its previous block is dropped.
  KeptBlock& make_room(std::uint32_t file, ReaderPosition at, ReaderPosition after, std::string_view text) {
    if (places_.empty()) places_.resize(places);
    KeptBlock& there = place(file, at.line);
    there.file = file;
    there.at = at;
    there.after = after;
    there.text.assign(text);
    return there;
  }
  // Empties the slot of a line that turned out to have no block.
  static void drop(KeptBlock& kept) { kept.at.line = 0; }

 private:
  // The offset prevents small files that call each other from sharing slots.
  KeptBlock& place(std::uint32_t file, std::uint32_t line) { return places_[(line + 61 * file) & (places - 1)]; }

  std::vector<KeptBlock> places_;  // allocated when a line is read for the second time
};

}  // namespace passo
