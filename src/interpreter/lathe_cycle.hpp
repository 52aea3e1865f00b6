// What a lathe cycle (G70 to G72) keeps while its contour is read and its moves are given.
#pragma once

#include <optional>
#include <string>

#include "block_words.hpp"
#include "lathe_moves.hpp"

#include "passo/gcode/symbols.hpp"
#include "passo/interpreter/operation.hpp"

namespace passo {

struct LatheCycle {
  static constexpr std::size_t most_segments = 10'000;

  CodeNumber code = 0;
  BlockWords words;  // of the cycle's block
  Span span;         // of its Q: what is wrong with the whole contour is told here
  std::string text;  // its line
  OperationSource source;
  Symbol sub;
  Point start;  // where the tool is before the first cut

  bool good = true;   // all lines of the contour so far
  LathePoint corner;  // the contour's last point so far
  LatheContour contour;

  std::optional<LatheRoughing> roughing;
  std::optional<LatheFinishing> finishing;
};

}  // namespace passo
