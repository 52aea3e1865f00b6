// DrillingCodes: the words of drilling, tapping and boring cycles (G73, G74, G81 … G89). The words are modal until
// another motion code, so a block with only X and Y drills the next hole. DrillingCycle generates the holes.
#pragma once

#include <optional>

#include "cycle_codes.hpp"
#include "drilling_cycle.hpp"

namespace passo {

class DrillingCodes final : public CycleCodes {
 public:
  explicit DrillingCodes(BlockContext& block) : CycleCodes(block) {}

  bool start(CodeNumber code);
  // Discards the words, because of another motion code.
  void forget() {
    if (kept_.code != 0) kept_ = {};
  }
  // Save and restore the words of the active cycle.
  void keep() { before_ = kept_; }
  void roll_back() { kept_ = before_; }
  Cycle& cycle() override { return *cycle_; }
  bool finish() override;

 private:
  // The words since the cycle's code, which apply to later blocks without them. Millimetres.
  struct KeptWords {
    CodeNumber code = 0;  // 0: no cycle is active
    Plane plane = Plane::xy;
    bool complete = false;  // false: the first block was invalid, so the following holes are not drilled
    double initial_height = 0;
    double retract = 0;  // R as written
    double depth = 0;    // the word of the depth axis as written
    double dwell = 0;
    double peck = 0;
    Point aside;  // G87: the lateral offset in the plane; along the depth axis, the top of the back bore as written
  };

  bool check(CodeNumber code, Point& hole);
  bool check_spindle(CodeNumber code);
  bool check_words(CodeNumber code, bool first, std::int32_t& holes);
  // Returns whether the block has the word, and the word belongs to the cycle and not to an M67 in the same block.
  bool takes(char letter) const { return words_.has(letter) && block_.motion->letters.has(letter); }
  void keep_words(bool first);
  bool check_depths(const DrillingPlan& plan);
  DrillingPlan plan_of(CodeNumber code, const Point& hole) const;
  void plan_way(DrillingPlan& plan) const;

  KeptWords kept_;
  KeptWords before_;  // the words saved by keep()
  std::optional<DrillingCycle> cycle_;
};

}  // namespace passo
