// KeptBlocks: the blocks of lines that are read again, so that the body of a loop or of a sub is parsed once.
//
// The line's number gives the place of its block. The next line with the same place replaces the block. So a body with
// as many lines as there are places is kept whole. Memory is bounded: about 1 KiB for each place in use, at most 10 MiB
// in all. A place keeps its capacity, so lines that share a place soon allocate nothing more.
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
  std::uint32_t file = 0;  // its number among those of the program
  ReaderPosition at{.offset = 0, .line = 0};
  ReaderPosition after;  // the line after it
  std::string text;      // the line; the block's views point into it
  Block block;
};

class KeptBlocks {
 public:
  static constexpr std::size_t places = 512;  // a power of two
  static constexpr std::size_t longest_text = 256;

  // The kept block of the line that begins there, or null.
  KeptBlock* find(std::uint32_t file, ReaderPosition at) {
    if (places_.empty()) return nullptr;
    KeptBlock& there = place(file, at.line);
    return there.at.line == at.line && there.at.offset == at.offset && there.file == file ? &there : nullptr;
  }
  // The place into which that line's block is to be parsed. The block that was there is gone.
  KeptBlock& make_room(std::uint32_t file, ReaderPosition at, ReaderPosition after, std::string_view text) {
    if (places_.empty()) places_.resize(places);
    KeptBlock& there = place(file, at.line);
    there.file = file;
    there.at = at;
    there.after = after;
    there.text.assign(text);
    return there;
  }
  // Empties a place whose line turned out to have no block.
  static void drop(KeptBlock& kept) { kept.at.line = 0; }

 private:
  // Small files that call each other do not share their places.
  KeptBlock& place(std::uint32_t file, std::uint32_t line) { return places_[(line + 61 * file) & (places - 1)]; }

  std::vector<KeptBlock> places_;  // made when a line comes again for the first time
};

}  // namespace passo
