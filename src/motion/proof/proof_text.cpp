#include "passo/proof/proof_text.hpp"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/base/counted.hpp"

namespace passo {
namespace {

using Json = nlohmann::ordered_json;

std::string multiple_of(const Finding& finding) {
  return finding.limit > 0 ? fmt::format("{:.4f} of the limit", finding.multiple()) : "no limit";
}

std::string time_and_line(const Finding& finding) {
  std::string place = fmt::format("{:.6f} s", finding.time.value());
  if (finding.line > 0) place += fmt::format(", line {}", finding.line);
  return place;
}

std::string row(const std::string& what, const Finding& finding, const char* unit) {
  return fmt::format("  {:<26}{:>20} {:>14.6g} {:<6} at {}\n", what, multiple_of(finding), finding.value, unit,
                     time_and_line(finding));
}

std::string step_row(const std::string& what, const Finding& finding, double noise, const char* unit) {
  return fmt::format("  {:<26}{:>20} {:>14.6g} {:<6} at {}; rounding {:.4f}\n", what, multiple_of(finding),
                     finding.value, unit, time_and_line(finding), finding.limit > 0 ? noise / finding.limit : 0);
}

std::string jump_row(const std::string& what, const Finding& finding, const char* unit) {
  return fmt::format("  {:<26}{:>20} {:>14.6g} {:<6} at {}\n", what, "", finding.value, unit, time_and_line(finding));
}

std::string text_of(const AxisProof& axis) {
  const bool turns = is_rotary(axis.axis);
  const char* speed = turns ? "deg/s" : "mm/s";
  const char* speed2 = turns ? "deg/s2" : "mm/s2";
  const char* speed3 = turns ? "deg/s3" : "mm/s3";
  std::string text = fmt::format("axis {}\n", letter_of(axis.axis));
  text += row("velocity", axis.velocity, speed);
  text += row("acceleration", axis.acceleration, speed2);
  text += row("jerk inside phases", axis.jerk, speed3);
  text += jump_row("jump of velocity", axis.velocity_jump, speed);
  text += jump_row("jump of acceleration", axis.acceleration_jump, speed2);
  if (axis.lost_motion.limit > 0) text += row("backlash not taken up", axis.lost_motion, turns ? "deg" : "mm");
  text += step_row("velocity of the steps", axis.step_velocity, axis.step_velocity_noise, speed);
  text += step_row("acceleration of the steps", axis.step_acceleration, axis.step_acceleration_noise, speed2);
  return text;
}

// JSON has no infinity.
Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json json_of(const Finding& finding) {
  Json json = {{"value", number(finding.value)},
               {"limit", finding.limit > 0 ? Json(finding.limit) : Json(nullptr)},
               {"multiple", finding.limit > 0 ? number(finding.multiple()) : Json(nullptr)},
               {"time_s", finding.time.value()}};
  if (finding.line > 0) json["line"] = finding.line;
  return json;
}

Json json_of(const Finding& finding, double noise) {
  Json json = json_of(finding);
  json["rounding"] = noise;
  json["within_rounding"] = !(finding.limit > 0) || finding.value <= finding.limit + noise;
  return json;
}

Json json_of(const AxisProof& axis) {
  Json json = {{"velocity", json_of(axis.velocity)},
               {"acceleration", json_of(axis.acceleration)},
               {"jerk", json_of(axis.jerk)},
               {"velocity_jump", json_of(axis.velocity_jump)},
               {"acceleration_jump", json_of(axis.acceleration_jump)},
               {"step_velocity", json_of(axis.step_velocity, axis.step_velocity_noise)},
               {"step_acceleration", json_of(axis.step_acceleration, axis.step_acceleration_noise)}};
  if (axis.lost_motion.limit > 0) json["lost_motion"] = json_of(axis.lost_motion);
  return json;
}

}  // namespace

std::string to_text(const MotionProof& proof) {
  std::string text = fmt::format("time         {:.6f} s, bound {:.6f} s, time / bound {:.4f}\n", proof.time.value(),
                                 proof.time_bound.value(), proof.times_bound());
  text += fmt::format("any path     bound {:.6f} s within the tolerance, time / bound {:.4f}\n",
                      proof.tube_bound.value(), proof.times_tube_bound());
  text += fmt::format("motion       {}, {}\n", counted(proof.moves, "move"), counted(proof.phases, "phase"));
  for (const AxisProof& axis : proof.axes) text += text_of(axis);
  text += "path\n";
  text += row("feed", proof.feed, "mm/s");
  text += row("deviation", proof.deviation, "mm");
  text += row("gap", proof.gap, "mm");
  const std::vector<std::string> faults = proof.faults();
  if (faults.empty()) return text + "good: within every limit\n";
  text += "NOT within its limits:\n";
  for (const std::string& fault : faults) text += "  " + fault + "\n";
  return text;
}

std::string to_json(const MotionProof& proof) {
  Json axes;
  for (const AxisProof& axis : proof.axes) axes[std::string(1, letter_of(axis.axis))] = json_of(axis);
  const Json json = {{"good", proof.good()},
                     {"time_s", proof.time.value()},
                     {"time_bound_s", proof.time_bound.value()},
                     {"time_over_bound", proof.times_bound()},
                     {"tube_bound_s", proof.tube_bound.value()},
                     {"time_over_tube_bound", proof.times_tube_bound()},
                     {"moves", proof.moves},
                     {"phases", proof.phases},
                     {"axes", axes},
                     {"feed", json_of(proof.feed)},
                     {"deviation", json_of(proof.deviation)},
                     {"gap", json_of(proof.gap)},
                     {"faults", proof.faults()}};
  return json.dump(2) + "\n";
}

}  // namespace passo
