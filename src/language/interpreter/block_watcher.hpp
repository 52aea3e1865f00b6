// BlockWatcher: sees each block before and after it is executed, with the state it runs under. For explain().
//
// The watcher is called once for each execution. A watcher that needs only some lines has to check the line first.
#pragma once

#include <string_view>

#include "parameters.hpp"
#include "program_state.hpp"

#include "passo/gcode/block.hpp"

namespace passo {

class BlockWatcher {
 public:
  virtual ~BlockWatcher() = default;
  // All arguments are borrowed until the call returns. `file` is the name of the file that the block is in.
  virtual void before(const Block& block, std::string_view file, const ProgramState& state,
                      const Parameters& parameters, const SymbolTable& symbols) = 0;
  virtual void after(const ProgramState& state) = 0;
};

}  // namespace passo
