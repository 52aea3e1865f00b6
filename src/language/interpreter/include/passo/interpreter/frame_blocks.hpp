// FrameBlocks: which codes of a block name places of the machine, or change where the work lies. For code that writes a
// program again: operations tell where the tool goes, but not that G53 sent it there, and G28.1 is no operation.
//
// It watches an interpreter. The operations of a block come after the block was executed, and before the next block is
// executed; only moves that cutter compensation holds back come later.
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

// A code as it is written, as "G43.1", and where. Column 0: the block has no such code.
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
  // The words with their values, lengths of axes in millimetres, whatever the program's units.
  std::vector<std::pair<char, double>> words = {};
  AxisSet named = {};        // axes of which the block has a word; polar words name X and Y
  bool incremental = false;  // the block's distances are incremental (G91)
  std::string cycle = {};    // the cycle in force, as "G81"
  bool to_start = false;     // cycles end at the height where they began (G98)
  double length_unit = 1;    // mm

  bool has(char letter) const;
  double value(char letter) const;  // 0: there is no such word
};

class FrameBlocks {
 public:
  // The interpreter must live for as long as this does, and must not be watched by anyone else.
  explicit FrameBlocks(Interpreter& interpreter);
  ~FrameBlocks();

  // The block that was executed last.
  const FrameBlock& last() const;
  // The blocks with one of the codes above that were executed since the last call, in order.
  std::vector<FrameBlock> take_executed();

 private:
  class Watcher;
  std::unique_ptr<Watcher> watcher_;
};

}  // namespace passo
