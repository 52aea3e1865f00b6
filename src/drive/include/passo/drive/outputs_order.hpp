// OutputsOrder: the outputs as the program has ordered them, with the operator's override of the spindle.
#pragma once

#include <optional>

#include "passo/path/segment.hpp"
#include "passo/wire/board_segment.hpp"

namespace passo {

// Converts the outputs of a path's action to the message for the wire.
BoardOutputs board_outputs(const OutputState& state, double spindle_factor = 1);

class OutputsOrder {
 public:
  // Takes the outputs that the program orders by an action. The board hears of the order in any case.
  void take_over(const Action& action) {
    ordered_ = action.outputs;
    heeds_override_ = action.heeds.spindle_override;
    told_.reset();
  }
  void order(const OutputState& outputs) { ordered_ = outputs; }
  // Whether the program heeds the override from here on (M48, M49, M51).
  void heed_override(bool heeds) { heeds_override_ = heeds; }
  bool heeds_override() const { return heeds_override_; }
  // The operator's factor, 0 to 2.
  void set_override(double factor) { override_ = factor; }
  const OutputState& ordered() const { return ordered_; }

  // True: the spindle is ordered to turn, and the board was told something else.
  bool is_news() const {
    const BoardOutputs wanted = for_board();
    const bool same = told_ && told_->switches == wanted.switches && told_->spindle_rpm == wanted.spindle_rpm;
    return ordered_.spindle != SpindleDirection::off && !same;
  }
  // The message for the board. The caller sends it.
  BoardOutputs tell() { return *(told_ = for_board()); }

 private:
  BoardOutputs for_board() const { return board_outputs(ordered_, heeds_override_ ? override_ : 1); }

  OutputState ordered_;
  bool heeds_override_ = true;
  double override_ = 1;
  std::optional<BoardOutputs> told_;
};

}  // namespace passo
