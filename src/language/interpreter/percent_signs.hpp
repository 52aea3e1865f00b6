// PercentSigns: a '%' before everything else but comments opens the program, and the next one closes it.
#pragma once

#include <utility>

namespace passo {

class PercentSigns {
 public:
  // Something else than a '%', a comment or an empty line was read.
  void note_content() { has_begun_ = true; }
  // A '%' was read. True: it closes the program.
  bool closes() {
    const bool ends = std::exchange(has_begun_, true);
    opened_ = opened_ || !ends;
    return ends;
  }
  // The program is read again from its start.
  void restart() { has_begun_ = false; }
  bool opened() const { return opened_; }

 private:
  bool has_begun_ = false;
  bool opened_ = false;
};

}  // namespace passo
