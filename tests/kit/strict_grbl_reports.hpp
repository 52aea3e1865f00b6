// What StrictGrbl reports: its state, offsets, modes and outputs; and how a door and a hold switch these.
#pragma once

#include "kit/strict_grbl.hpp"

namespace passo {

inline std::string StrictGrbl::places(const Point& place) const {
  const bool inches = values_[13] != 0;
  std::string text;
  for (const char letter : axes) {
    const double value = place[*axis_of(letter)];
    text += (text.empty() ? "" : ",") + (inches ? fmt::format("{:.4f}", value / 25.4) : fmt::format("{:.3f}", value));
  }
  return text;
}

inline std::string StrictGrbl::rate(double mm_per_minute) const {
  return values_[13] != 0 ? fmt::format("{:.1f}", mm_per_minute / 25.4) : fmt::format("{:.0f}", mm_per_minute);
}

inline void StrictGrbl::report() {
  if (own_report) return say(own_report());
  const auto mask = static_cast<unsigned>(values_[10]);
  const Point zero = modes_.zero();
  const Point machine = motion_.place();
  std::string text = "<" + state;
  text += (mask & 1U) != 0 ? "|MPos:" + places(machine) : "|WPos:" + places(machine - zero);
  if ((mask & 2U) != 0) text += fmt::format("|Bf:{},{}", motion_.free_blocks(), bytes_ - ring_.size());
  if (line_numbers && motion_.number() > 0) text += fmt::format("|Ln:{}", motion_.number());
  const double speed = spindle_ == 5 ? 0 : spindle_speed_ * spindle_override_ / 100;
  text += "|FS:" + rate(motion_.speed() * 60) + fmt::format(",{:.0f}", speed);
  const bool touches = probe && probe(machine);
  std::string pins = touches ? "P" : "";
  for (const char axis : axes) {
    if (closed_limits_.find(axis) != std::string::npos) pins += axis;
  }
  pins += std::string(door_is_open_ ? "D" : "") + (held_input ? "H" : "");
  if (!pins.empty()) text += "|Pn:" + pins;
  const bool busy = state != "Idle" && state != "Alarm" && state != "Check" && state != "Sleep";
  if (offset_count_ > 0) {
    --offset_count_;
  } else {
    offset_count_ = busy ? 29 : 9;
    if (override_count_ == 0) override_count_ = 1;
    text += "|WCO:" + places(zero);
  }
  if (override_count_ > 0) {
    --override_count_;
  } else {
    override_count_ = busy ? 19 : 9;
    text += fmt::format("|Ov:{},{},{}", feed_override_, rapid_override_, spindle_override_);
    std::string outputs = spindle_ == 3 ? "S" : spindle_ == 4 ? "C" : "";
    if (flood_) outputs += "F";
    if (mist_) outputs += "M";
    if (!outputs.empty()) text += "|A:" + outputs;
  }
  say(text + ">");
}

inline void StrictGrbl::say_offsets() {
  if (!offsets.empty()) return add_reply(offsets);
  for (std::size_t i = 0; i < modes_.systems.size(); ++i)
    say(fmt::format("[G{}:{}]", 54 + i, places(modes_.systems[i])));
  say("[G28:" + places(modes_.g28) + "]");
  say("[G30:" + places(modes_.g30) + "]");
  say("[G92:" + places(modes_.g92) + "]");
  say(values_[13] != 0 ? fmt::format("[TLO:{:.4f}]", modes_.tool_length / 25.4)
                       : fmt::format("[TLO:{:.3f}]", modes_.tool_length));
  say("[PRB:" + places(probed_) + (probe_succeeded_ ? ":1]" : ":0]"));
}

inline void StrictGrbl::say_modes() {
  if (!modes.empty()) return say("[GC:" + modes + "]");
  const std::string motion =
      modes_.motion > 300 ? fmt::format("G38.{}", modes_.motion - 380) : fmt::format("G{}", modes_.motion);
  std::string coolant = std::string(modes_.mist ? " M7" : "") + (modes_.flood ? " M8" : "");
  if (coolant.empty()) coolant = " M9";
  say(fmt::format("[GC:{} G{} G{} G{} G{} G{} M{}{} T{} F{} S{:.0f}]", motion, modes_.system, modes_.plane,
                  modes_.units, modes_.distance, modes_.feed_mode, modes_.spindle, coolant, modes_.tool,
                  rate(modes_.feed), modes_.speed));
}

// Toggles.
inline void StrictGrbl::stop_spindle() {
  if (modes_.spindle == 5) return;
  if (spindle_ == 5) say("[MSG:Restoring spindle]");
  spindle_ = spindle_ == 5 ? modes_.spindle : 5;
  override_count_ = 0;
}

// At rest behind an open door.
inline void StrictGrbl::switch_off() {
  spindle_ = 5;
  flood_ = mist_ = false;
  override_count_ = 0;
}

// The spindle turns again; then the coolant comes, and then the motion.
inline void StrictGrbl::go_on_after_door() {
  if (!std::exchange(restores_coolant_, false)) return resume();
  flood_ = modes_.flood;
  mist_ = modes_.mist;
  override_count_ = 0;
  restores_until_ = now_ + door_coolant_time;
}

}  // namespace passo
