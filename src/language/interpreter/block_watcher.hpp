// BlockWatcher: observes each block before and after its execution, with the state in which it is executed. For
// explain().
//
// The observer is called for each execution. An observer that needs only some lines should check the line first.
#pragma once

#include <string_view>

#include "parameters.hpp"
#include "program_state.hpp"

#include "passo/gcode/block.hpp"

namespace passo {

class BlockWatcher {
 public:
  virtual ~BlockWatcher() = default;
  // All arguments are valid only until the call returns. `file` is the name of the file that contains the block.
  virtual void before(const Block& block, std::string_view file, const ProgramState& state,
                      const Parameters& parameters, const SymbolTable& symbols) = 0;
  virtual void after(const ProgramState& state) = 0;
};

}  // namespace passo
