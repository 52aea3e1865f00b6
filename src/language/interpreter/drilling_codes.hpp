// DrillingCodes: the words of drilling, tapping and boring cycles (G73, G74, G81 … G89). The words stay valid until
// another motion code, so a block with only X and Y drills the next hole. DrillingCycle makes the holes.
#pragma once

#include <optional>

#include "cycle_codes.hpp"
#include "drilling_cycle.hpp"

namespace passo {

class DrillingCodes final : public CycleCodes {
 public:
  explicit DrillingCodes(BlockContext& block) : CycleCodes(block) {}

  bool start(CodeNumber code);
  // Another motion code came: the words are no longer valid.
  void forget() {
    if (kept_.code != 0) kept_ = {};
  }
  // Notes the words of the active cycle, and goes back to them.
  void keep() { before_ = kept_; }
  void roll_back() { kept_ = before_; }
  Cycle& cycle() override { return *cycle_; }
  bool finish() override;

 private:
  // The words of the blocks since the cycle's code. They count in the blocks that leave them out. Millimetres.
  struct KeptWords {
    CodeNumber code = 0;  // 0: no cycle is active
    Plane plane = Plane::xy;
    bool complete = false;  // false: the first block was wrong, so the following holes are not drilled
    double initial_height = 0;
    double retract = 0;  // R as written
    double depth = 0;    // the depth axis' word as written
    double dwell = 0;
    double peck = 0;
    Point aside;  // G87: the way aside in the plane, and along the depth axis the top of the back bore as written
  };

  bool check(CodeNumber code, Point& hole);
  bool check_spindle(CodeNumber code);
  bool check_words(CodeNumber code, bool first, std::int32_t& holes);
  // True: the block has the word, and it is the cycle's, not that of an M67 beside it.
  bool takes(char letter) const { return words_.has(letter) && block_.motion->letters.has(letter); }
  void keep_words(bool first);
  bool check_depths(const DrillingPlan& plan);
  DrillingPlan plan_of(CodeNumber code, const Point& hole) const;
  void plan_way(DrillingPlan& plan) const;

  KeptWords kept_;
  KeptWords before_;  // at keep()
  std::optional<DrillingCycle> cycle_;
};

}  // namespace passo
