// KeptBlocks: the blocks of lines that are read again, so that the body of a loop or of a sub is parsed once.
//
// A line's block has its place by the line's number, and the next one that falls there takes it: a body of as many
// lines as there are places is kept whole. Bounded: about 1 KiB a place in use, 10 MiB in all at the very worst. A
// place keeps its capacity, so that lines that take turns allocate nothing once it is warm.
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
  std::string text;      // the line; what the block's views point into
  Block block;
};

class KeptBlocks {
 public:
  static constexpr std::size_t places = 512;  // a power of two
  static constexpr std::size_t longest_text = 256;

  // Null where the line that begins there is not kept.
  KeptBlock* find(std::uint32_t file, ReaderPosition at) {
    if (places_.empty()) return nullptr;
    KeptBlock& there = place(file, at.line);
    return there.at.line == at.line && there.at.offset == at.offset && there.file == file ? &there : nullptr;
  }
  // The place of that line, for its block to be parsed into; what was there is gone.
  KeptBlock& make_room(std::uint32_t file, ReaderPosition at, ReaderPosition after, std::string_view text) {
    if (places_.empty()) places_.resize(places);
    KeptBlock& there = place(file, at.line);
    there.file = file;
    there.at = at;
    there.after = after;
    there.text.assign(text);
    return there;
  }
  // It has no block after all.
  static void drop(KeptBlock& kept) { kept.at.line = 0; }

 private:
  // Small files that call each other do not share their places.
  KeptBlock& place(std::uint32_t file, std::uint32_t line) { return places_[(line + 61 * file) & (places - 1)]; }

  std::vector<KeptBlock> places_;  // made when a line comes again for the first time
};

}  // namespace passo
