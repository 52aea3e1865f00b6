#include "passo/sender/grbl_code.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>

#include <fmt/format.h>

namespace passo {
namespace {

constexpr double places = 1e4;             // of a millimetre
constexpr double chord_tolerance = 0.002;  // mm
constexpr double same_radius = 0.002;      // mm; Grbl itself takes 0.005
constexpr double shortest_arc = 0.05;      // mm, from end to end: rounding hardly turns it
constexpr double most_chords = 20000;      // of one curve
constexpr std::array linear = {Axis::x, Axis::y, Axis::z};

// Without zeros at its end.
std::string number(std::int64_t value) {
  std::string text = fmt::format("{:.4f}", static_cast<double>(value) / places);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::int64_t written(double value) {
  return std::llround(value * places);
}

struct ArcPlane {
  int code;
  std::array<char, 2> center;  // the words of the centre, in the order of ArcData
};
ArcPlane plane_of(const Curve::ArcData& arc) {
  if (arc.first == Axis::z) return {18, {'K', 'I'}};
  if (arc.first == Axis::y) return {19, {'J', 'K'}};
  return {17, {'I', 'J'}};
}

bool is_xyz(Axis axis) {
  return std::ranges::find(linear, axis) != linear.end();
}

// Of an inverse time, which may be long: six decimals.
std::string inverse_time(double per_minute) {
  std::string text = fmt::format("{:.6f}", std::max(per_minute, 1e-6));
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text;
}

bool moves_beyond_xyz(const Curve& curve) {
  return std::ranges::any_of(all_axes, [&](Axis axis) { return !is_xyz(axis) && curve.moves(axis); });
}

Failure<std::string> cannot(std::string words) {
  return Failure{std::move(words)};
}

}  // namespace

Status<std::string> GrblCode::write(const PathItem& item, std::vector<std::string>& lines) {
  if (const auto* segment = std::get_if<Segment>(&item)) return write_segment(*segment, lines);
  return write_action(std::get<Action>(item), lines);
}

GrblCode::Place GrblCode::rounded(const Point& machine) const {
  Place place;
  for (const Axis axis : all_axes) {
    if (target_.axes.has(axis)) place[axis] = written(machine[axis] - target_.zero[axis]);
  }
  return place;
}

Status<std::string> GrblCode::write_segment(const Segment& segment, std::vector<std::string>& lines) {
  const Curve& curve = segment.curve;
  for (const Axis axis : all_axes) {
    if (!curve.moves(axis)) continue;
    if (!target_.axes.has(axis)) return cannot(fmt::format("it has no axis {}", letter_of(axis)));
    moved_.add(axis);
  }
  if (segment.lock == SpindleLock::place) return cannot("it cannot follow the spindle (G33)");
  if (segment.reverse_at > Mm(0)) return cannot("it cannot tap (G33.1)");
  const double feed = segment.rapid ? 0 : segment.speed.value() * 60;
  const bool is_round = curve.shape() == Curve::Shape::arc;
  const Curve::ArcData& arc = curve.arc_data();
  const bool is_grbl_arc = is_round && std::abs(arc.end_radius - arc.start_radius) <= same_radius;
  // The motors of a CoreXY move by other ways in an arc that is not in the XY plane.
  const bool is_even = !target_.measures_motors || plane_of(arc).code == 17;
  if (is_grbl_arc && is_even && !moves_beyond_xyz(curve)) {
    write_arc(curve, feed, lines);
  } else if (curve.shape() != Curve::Shape::line) {
    write_chords(curve, feed, lines);
  } else {
    write_line(curve.start(), curve.end(), feed, curve.length().value(), lines);
  }
  if (segment.mode == PathMode::exact_stop) lines.emplace_back(wait_for_rest);
  return Unit{};
}

void GrblCode::write_chords(const Curve& curve, double feed, std::vector<std::string>& lines) {
  const double length = curve.length().value();
  const double wanted = std::ceil(length * std::sqrt(curve.curvature() / (8 * chord_tolerance)));
  const int pieces = static_cast<int>(std::clamp(wanted, 1.0, most_chords));
  Point from = curve.start();
  for (int i = 1; i <= pieces; ++i) {
    const Point to = i == pieces ? curve.end() : curve.at(Mm(length * i / pieces));
    write_line(from, to, feed, length / pieces, lines);
    from = to;
  }
}

void GrblCode::write_line(const Point& start, const Point& end, double feed, double length,
                          std::vector<std::string>& lines) {
  const std::string words = words_to(rounded(end), false);
  if (words.empty()) return;
  if (feed <= 0) {
    lines.push_back(code_words(0, 0) + words);
    return;
  }
  const Point step = end - start;
  bool beyond_xyz = false;
  bool turns = false;
  bool shifts = false;
  for (const Axis axis : all_axes) {
    if (step[axis] == 0) continue;
    beyond_xyz = beyond_xyz || !is_xyz(axis);
    (is_rotary(axis) ? turns : shifts) = true;
  }
  const bool by_time = turns && shifts && target_.feed_way == GrblFirmware::FeedWay::depends_on_build;
  if (by_time) {
    feed /= length;
  } else if ((beyond_xyz || target_.measures_motors) && length > 0) {
    feed *= target_.way(step) / length;
  }
  lines.push_back(code_words(1, feed, by_time) + words);
}

// A piece turns by half a turn at most. Grbl takes an arc whose ends are the same for a full circle, so an arc whose
// ends lie close to each other becomes chords.
void GrblCode::write_arc(const Curve& curve, double feed, std::vector<std::string>& lines) {
  const Curve::ArcData& arc = curve.arc_data();
  const double length = curve.length().value();
  const int pieces = std::max(1, static_cast<int>(std::ceil(std::abs(arc.sweep) / std::numbers::pi - 1e-9)));
  const double turn = std::abs(arc.sweep) / pieces;
  if (2 * arc.start_radius * std::sin(turn / 2) < shortest_arc) return write_chords(curve, feed, lines);
  const ArcPlane plane = plane_of(arc);
  if (target_.measures_motors) {
    const double rise = curve.end()[Axis::z] - curve.start()[Axis::z];
    feed *= std::sqrt(2 - rise * rise / (length * length));
  }
  for (int i = 0; i < pieces; ++i) {
    // From where the machine truly stands: there the rounding of the last end is.
    const Place from = rounded(curve.at(Mm(length * i / pieces)));
    const Place to = rounded(i + 1 == pieces ? curve.end() : curve.at(Mm(length * (i + 1) / pieces)));
    const std::int64_t first = written(arc.first_center - target_.zero[arc.first]) - from[arc.first];
    const std::int64_t second = written(arc.second_center - target_.zero[arc.second]) - from[arc.second];
    std::string text;
    if (plane_ != plane.code) text = fmt::format("G{}", plane.code);
    plane_ = plane.code;
    // The machine stands at the beginning, though nothing may have been written of its axes.
    text += code_words(arc.sweep > 0 ? 3 : 2, feed);
    text += words_to(to, true);
    text += plane.center[0] + number(first) + plane.center[1] + number(second);
    lines.push_back(std::move(text));
  }
}

// In inverse time each line has its F. After a change of the mode F is not defined.
std::string GrblCode::code_words(int code, double feed, bool by_time) {
  std::string text;
  if (code != 0 && by_time != by_time_) {
    text = by_time ? "G93" : "G94";
    by_time_ = by_time;
    feed_ = -1;
  }
  if (code != code_) text += fmt::format("G{}", code);
  code_ = code;
  if (by_time) return text + "F" + inverse_time(feed);
  const std::int64_t rate = std::max<std::int64_t>(1, written(feed));
  if (code != 0 && rate != feed_) {
    text += "F" + number(rate);
    feed_ = rate;
  }
  return text;
}

// The words of the axes that are elsewhere; of an arc, X, Y and Z.
std::string GrblCode::words_to(const Place& place, bool all_of_xyz) {
  std::string text;
  for (const Axis axis : all_axes) {
    if (!target_.axes.has(axis) || !moved_.has(axis) || (all_of_xyz && !is_xyz(axis))) continue;
    if (!all_of_xyz && sure_.has(axis) && at_[axis] == place[axis]) continue;
    text += letter_of(axis) + number(place[axis]);
    sure_.add(axis);
  }
  at_ = place;
  return text;
}

void GrblCode::set_outputs(const OutputState& wanted, std::vector<std::string>& lines) {
  const bool stops = (outputs_.mist && !wanted.mist) || (outputs_.flood && !wanted.flood);
  const std::int64_t speed = written(wanted.revolutions_per_minute);
  const bool turns = wanted.spindle != SpindleDirection::off;
  if (turns && (wanted.spindle != outputs_.spindle || speed != spindle_speed_)) {
    lines.push_back((wanted.spindle == SpindleDirection::clockwise ? "M3S" : "M4S") + number(speed));
    spindle_speed_ = speed;
  } else if (!turns && outputs_.spindle != SpindleDirection::off) {
    lines.emplace_back("M5");
  }
  if (stops) lines.emplace_back("M9");
  if (wanted.mist && (stops || !outputs_.mist)) lines.emplace_back("M7");
  if (wanted.flood && (stops || !outputs_.flood)) lines.emplace_back("M8");
  outputs_ = wanted;
}

Status<std::string> GrblCode::write_action(const Action& action, std::vector<std::string>& lines) {
  switch (action.kind) {
    case Action::Kind::probe_begin:
    case Action::Kind::probe_end: return cannot("Passo cannot read the result of its probe: probe with another sender");
    case Action::Kind::await_index:
    case Action::Kind::tap_turns: return cannot("it cannot follow the spindle");
    default: break;
  }
  if (action.outputs.mist && !target_.has_mist) return cannot("it was built without mist coolant (M7)");
  set_outputs(action.outputs, lines);
  if (action.kind == Action::Kind::dwell && action.dwell > Seconds(0)) {
    lines.push_back("G4P" + number(std::max<std::int64_t>(1, written(action.dwell.value()))));
  }
  return Unit{};
}

}  // namespace passo
