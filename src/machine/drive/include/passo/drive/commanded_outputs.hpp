// CommandedOutputs: the outputs as commanded by the program, with the operator's overrides.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <optional>

#include "passo/path/segment.hpp"
#include "passo/wire/board_segment.hpp"

namespace passo {

// Converts the outputs of a path's action to the message for the board.
BoardOutputs board_outputs(const OutputState& state, double spindle_factor = 1);

class CommandedOutputs {
 public:
  // Applies the outputs that an action of the program commands. The board always receives the command.
  void apply(const Action& action) {
    ordered_ = action.outputs;
    if (mist_ && mist_->ordered != ordered_.mist) mist_.reset();
    if (flood_ && flood_->ordered != ordered_.flood) flood_.reset();
    override_enabled_ = action.heeds.spindle_override;
    told_.reset();
  }
  void order(const OutputState& outputs) { ordered_ = outputs; }
  // Applies the outputs that the path switches in motion.
  void apply(const PathOutputs& outputs) {
    in_motion_.power = outputs.power;
    if (outputs.switches) in_motion_.switches = outputs.switches;
  }
  // The digital outputs (bits of OutputSwitch) that stay as they are when motion stops inside the path.
  void keep_in_stops(std::uint8_t switches) { kept_ = switches; }
  // The motion stops inside the path, by a hold or a stop ramp: until go_on() the laser is off, and so are the digital
  // outputs that are not kept. Both functions return true if the board must be told.
  [[nodiscard]] bool halt() { return set_halted(true); }
  [[nodiscard]] bool go_on() { return halted_ && set_halted(false); }
  // The board has switched its outputs off by itself.
  void forget_told() {
    told_.reset();
    halted_ = true;
  }
  // Sets whether the program enables the spindle override from here on (M48, M49, M51).
  void enable_override(bool heeds) { override_enabled_ = heeds; }
  bool override_enabled() const { return override_enabled_; }
  // The operator's factor, 0 to 2.
  void set_override(double factor) { override_ = factor; }
  const OutputState& ordered() const { return ordered_; }
  // A setting of the operator is valid until the program switches the same output.
  void switch_mist(bool on) { mist_.emplace(Switched{.on = on, .ordered = ordered_.mist}); }
  void switch_flood(bool on) { flood_.emplace(Switched{.on = on, .ordered = ordered_.flood}); }
  // Stops the spindle; it stays off until stop_spindle(false).
  void stop_spindle(bool stands) { spindle_stands_ = stands; }
  bool spindle_stands() const { return spindle_stands_; }
  // Switches all outputs of the program off until stop_all(false), because the door is open.
  void stop_all(bool stands) { all_stand_ = stands; }
  bool all_stand() const { return all_stand_; }
  // The outputs to be applied now.
  OutputState in_force() const {
    OutputState outputs = ordered_;
    if (mist_) outputs.mist = mist_->on;
    if (flood_) outputs.flood = flood_->on;
    if (spindle_stands_ || all_stand_) outputs.spindle = SpindleDirection::off;
    if (all_stand_) outputs.mist = outputs.flood = false;
    return outputs;
  }

  // Returns true if the spindle or the laser is commanded on, and the board's last command is different.
  bool is_news() const {
    return (in_force().spindle != SpindleDirection::off || laser_power() > 0) && told_ != for_board();
  }
  // The difference of the spindle speed from the board's commanded speed, rpm.
  double change_of_speed() const { return told_ ? std::abs(for_board().spindle_rpm - told_->spindle_rpm) : 0; }
  // Returns the message for the board, and records it as sent. The caller sends it.
  BoardOutputs tell() { return *(told_ = for_board()); }

 private:
  struct Switched {
    bool on = false;
    bool ordered = false;  // as commanded by the program at that time
  };
  BoardOutputs for_board() const;
  bool set_halted(bool halted);
  double laser_power() const { return halted_ || all_stand_ || spindle_stands_ ? 0 : in_motion_.power; }
  double spindle_factor() const { return override_enabled_ ? override_ : 1; }

  OutputState ordered_;
  bool override_enabled_ = true;
  double override_ = 1;
  std::optional<Switched> mist_;
  std::optional<Switched> flood_;
  bool spindle_stands_ = false;
  bool all_stand_ = false;
  PathOutputs in_motion_;
  std::uint8_t kept_ = 0;
  bool halted_ = false;
  std::optional<BoardOutputs> told_;
};

}  // namespace passo
