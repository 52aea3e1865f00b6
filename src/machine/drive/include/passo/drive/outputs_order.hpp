// OutputsOrder: the outputs as the program has ordered them, with the operator's override of the spindle.
#pragma once

#include <cstdlib>
#include <optional>

#include "passo/path/segment.hpp"
#include "passo/wire/board_segment.hpp"

namespace passo {

// Converts the outputs of a path's action to the message for the wire.
BoardOutputs board_outputs(const OutputState& state, double spindle_factor = 1);

class OutputsOrder {
 public:
  // Takes the outputs that the program orders by an action. The board hears of the order in any case.
  void apply(const Action& action) {
    ordered_ = action.outputs;
    if (mist_ && mist_->ordered != ordered_.mist) mist_.reset();
    if (flood_ && flood_->ordered != ordered_.flood) flood_.reset();
    override_enabled_ = action.heeds.spindle_override;
    told_.reset();
  }
  void order(const OutputState& outputs) { ordered_ = outputs; }
  // Whether the program heeds the override from here on (M48, M49, M51).
  void enable_override(bool heeds) { override_enabled_ = heeds; }
  bool override_enabled() const { return override_enabled_; }
  // The operator's factor, 0 to 2.
  void set_override(double factor) { override_ = factor; }
  const OutputState& ordered() const { return ordered_; }
  // What the operator has switched counts until the program switches the same itself.
  void switch_mist(bool on) { mist_.emplace(Switched{.on = on, .ordered = ordered_.mist}); }
  void switch_flood(bool on) { flood_.emplace(Switched{.on = on, .ordered = ordered_.flood}); }
  // The spindle stands until it is let go.
  void stop_spindle(bool stands) { spindle_stands_ = stands; }
  bool spindle_stands() const { return spindle_stands_; }
  // All outputs that a program switches stand still until they are let go: the door is open.
  void stop_all(bool stands) { all_stand_ = stands; }
  bool all_stand() const { return all_stand_; }
  // The outputs as they are to be now.
  OutputState in_force() const {
    OutputState outputs = ordered_;
    if (mist_) outputs.mist = mist_->on;
    if (flood_) outputs.flood = flood_->on;
    if (spindle_stands_ || all_stand_) outputs.spindle = SpindleDirection::off;
    if (all_stand_) outputs.mist = outputs.flood = false;
    return outputs;
  }

  // True: the spindle is ordered to turn, and the board was told something else.
  bool is_news() const {
    const BoardOutputs wanted = for_board();
    const bool same = told_ && told_->switches == wanted.switches && told_->spindle_rpm == wanted.spindle_rpm;
    return in_force().spindle != SpindleDirection::off && !same;
  }
  // How far the spindle's speed is from what the board was told, revolutions a minute.
  double change_of_speed() const { return told_ ? std::abs(for_board().spindle_rpm - told_->spindle_rpm) : 0; }
  // The message for the board. The caller sends it.
  BoardOutputs tell() { return *(told_ = for_board()); }

 private:
  struct Switched {
    bool on = false;
    bool ordered = false;  // by the program at that time
  };
  BoardOutputs for_board() const { return board_outputs(in_force(), override_enabled_ ? override_ : 1); }

  OutputState ordered_;
  bool override_enabled_ = true;
  double override_ = 1;
  std::optional<Switched> mist_;
  std::optional<Switched> flood_;
  bool spindle_stands_ = false;
  bool all_stand_ = false;
  std::optional<BoardOutputs> told_;
};

}  // namespace passo
