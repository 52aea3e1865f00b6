// UnreadableLabels: the labels of O-words in unreadable lines. Missing counterparts of these labels are not reported,
// since the unreadable line may contain them.
#pragma once

#include <cstdint>
#include <set>

#include "passo/gcode/block.hpp"

namespace passo {

class UnreadableLabels {
 public:
  void add(Symbol label) { some_.insert(label.id); }
  // Used if the label of an O-word is unreadable, too.
  void add_all() { all_ = true; }
  bool has(Symbol label) const { return all_ || some_.contains(label.id); }

 private:
  std::set<std::uint32_t> some_;
  bool all_ = false;
};

}  // namespace passo
