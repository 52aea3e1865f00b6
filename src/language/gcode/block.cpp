#include "passo/gcode/block.hpp"

#include <utility>

namespace passo {

void Block::clear() {
  line = 0;
  text = {};
  block_delete = false;
  percent = false;
  line_number.reset();
  spaced_number.reset();
  words.clear();
  assignments.clear();
  comments.clear();
  if (control) {
    spare = std::move(control->arguments);
    spare.clear();
    control.reset();
  }
  code.clear();
}

}  // namespace passo
