// FrameBlocks: records which codes of a block use machine positions or change the work frame. It is for code that
// rewrites a program: operations contain the target of a move, but not that G53 was used, and G28.1 is not an
// operation.
//
// It observes an interpreter. The operations of a block follow its execution, before that of the next block; only moves
// delayed by cutter compensation come later.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "passo/geometry/axes.hpp"
#include "passo/interpreter/interpreter.hpp"

namespace passo {

// A code as written, e.g. "G43.1", and its position. Column 0: the block has no such code.
struct FrameCode {
  std::string name = {};
  WordPlace place = {};

  bool empty() const { return name.empty(); }
};

struct FrameBlock {
  std::uint64_t number = 0;  // counts the executed blocks
  std::uint32_t line = 0;
  std::string file = {};
  std::string text = {};
  FrameCode place = {};   // G10, G28, G28.1, G30, G30.1, G52, G53, G92, G92.1, G92.2 or G92.3
  FrameCode tool = {};    // G43, G43.1, G43.2 or G49
  FrameCode system = {};  // G54 to G59.3
  // The words with their values; axis lengths are in millimetres, independent of the program's units.
  std::vector<std::pair<char, double>> words = {};
  AxisSet named = {};        // axes with a word in the block; polar words count as X and Y
  bool incremental = false;  // the block's distances are incremental (G91)
  std::string cycle = {};    // the active cycle, e.g. "G81"
  bool to_start = false;     // cycles retract to the initial level (G98)
  double length_unit = 1;    // mm

  bool has(char letter) const;
  double value(char letter) const;  // 0: there is no such word
};

class FrameBlocks {
 public:
  // The interpreter must outlive this object, and must not have another observer.
  explicit FrameBlocks(Interpreter& interpreter);
  ~FrameBlocks();

  // Returns the last executed block.
  const FrameBlock& last() const;
  // Returns the blocks with one of the codes above that were executed since the last call, in order.
  std::vector<FrameBlock> take_executed();

 private:
  class Watcher;
  std::unique_ptr<Watcher> watcher_;
};

}  // namespace passo
