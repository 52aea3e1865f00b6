// PercentSigns: a '%' before everything else except comments opens the program, and the next one closes it.
#pragma once

#include <utility>

namespace passo {

class PercentSigns {
 public:
  // Notes that something other than a '%', a comment or an empty line was read.
  void note_content() { has_begun_ = true; }
  // Notes a '%'. Returns true if it closes the program.
  bool closes() {
    const bool ends = std::exchange(has_begun_, true);
    opened_ = opened_ || !ends;
    return ends;
  }
  // Notes that the program is read again from its start.
  void restart() { has_begun_ = false; }
  bool opened() const { return opened_; }

 private:
  bool has_begun_ = false;
  bool opened_ = false;
};

}  // namespace passo
