// DoubtfulLabels: the labels of O-words that cannot be read. What lacks one of them is not reported: the line that
// cannot be read may hold it.
#pragma once

#include <cstdint>
#include <set>

#include "passo/gcode/block.hpp"

namespace passo {

class DoubtfulLabels {
 public:
  void add(Symbol label) { some_.insert(label.id); }
  // The label of an O-word cannot be read either.
  void add_all() { all_ = true; }
  bool has(Symbol label) const { return all_ || some_.contains(label.id); }

 private:
  std::set<std::uint32_t> some_;
  bool all_ = false;
};

}  // namespace passo
