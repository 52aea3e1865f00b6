// BlockParser: parses a line of text into a Block. About 100 ns for a short line. After the first few lines, it
// allocates no memory.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/gcode/block.hpp"

namespace passo {

class BlockParser {
 public:
  // `file` names the program in diagnostics.
  BlockParser(std::string file, SymbolTable& symbols) : file_(std::move(file)), symbols_(symbols) {}

  // Allows N anywhere in a line, as in Grbl. In RS274/NGC it must be first.
  void accept_line_numbers_anywhere() { line_numbers_anywhere_ = true; }

  // Returns false if the line has an error. The error is then in `diagnostics`, and the block must not be used.
  [[nodiscard]] bool parse(std::string_view text, std::uint32_t line, Block& block, Diagnostics& diagnostics) const;

 private:
  std::string file_;
  SymbolTable& symbols_;
  bool line_numbers_anywhere_ = false;
};

// Returns the block as G-code in canonical spelling: parse(print(b)) == b.
std::string print(const Block& block, const SymbolTable& symbols);

}  // namespace passo
