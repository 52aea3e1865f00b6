#include "passo/sender/grbl_follower.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "passo/geometry/euclid.hpp"
#include "passo/sender/grbl_reply.hpp"

namespace passo {
namespace {

constexpr double report_resolution = 0.01;   // mm: reports have three decimals
constexpr double steps_beside_the_path = 2;  // of each motor
constexpr int most_strikes = 2;
constexpr double kept_behind = 0.5;      // mm of the path behind the known position
constexpr double shortest_chord = 0.06;  // mm, from end to end of an arc
constexpr double smallest_speed = 0.05;  // mm/s
constexpr double response = 0.1;         // s: the connection and the host
constexpr double most_pieces = 2000;     // of one line

// As GrblCode writes numbers.
std::string number_text(double value) {
  std::string text = fmt::format("{:.4f}", value);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

double turn_of(const GrblLineMotion& line) {
  const GrblPlanner::Arc& arc = *line.arc;
  const double x = -arc.first_center;
  const double y = -arc.second_center;
  const double to_x = line.end[arc.first] - line.start[arc.first] + x;
  const double to_y = line.end[arc.second] - line.start[arc.second] + y;
  double turn = std::atan2(x * to_y - y * to_x, x * to_x + y * to_y);
  if (arc.clockwise && turn >= -5e-7) turn -= 2 * std::numbers::pi;
  if (!arc.clockwise && turn <= 5e-7) turn += 2 * std::numbers::pi;
  return turn;
}

// The words of a line without those that the letters begin.
std::string words_without(const std::string& text, std::string_view letters) {
  std::string kept;
  bool keeps = true;
  for (const char one : text) {
    if (one >= 'A' && one <= 'Z') keeps = letters.find(one) == std::string_view::npos;
    if (keeps && one != '\n') kept += one;
  }
  return kept;
}

}  // namespace

GrblFollower::GrblFollower(const GrblLimits& limits, const Point& start, const Point& zero, Seconds ahead)
    : limits_(limits), ahead_(ahead), added_reader_(start, zero), sent_reader_(start, zero), model_(limits, start) {
  path_.end = start;
  double squares = 0;
  for (const double per_mm : limits.steps_per_mm.values) squares += per_mm > 0 ? 1 / (per_mm * per_mm) : 0;
  tolerance_ = report_resolution + limits.arc_tolerance.value() + steps_beside_the_path * std::sqrt(squares);
}

// The speed as the board measures it.
double GrblFollower::measured_speed(const Point& way, MmPerSecond feed) const {
  const Point measured = limits_.measured(way);
  const double length = length_of(measured);
  double speed = limits_.measured_feed(way, feed).value();
  for (const Axis axis : all_axes) {
    const double part = std::abs(measured[axis]);
    if (part > 0 && limits_.steps_per_mm[axis] > 0) {
      speed = std::min(speed, limits_.velocity[axis].value() * length / part);
    }
  }
  return std::max(speed, smallest_speed);
}

// The speed of the tool.
double GrblFollower::speed_of(const Point& way, MmPerSecond feed) const {
  const double speed = measured_speed(way, feed);
  if (!limits_.core_xy) return speed;
  const double length = length_of(way);
  // A full circle has no way from end to end.
  return speed * (length > 0 ? length / length_of(limits_.measured(way)) : std::numbers::sqrt2 / 2);
}

double GrblFollower::duration_of(const GrblLineMotion& line) const {
  if (line.kind != GrblLineMotion::Kind::move) return 0;
  double length = length_of(line.end - line.start);
  if (line.arc) length = std::abs(turn_of(line)) * std::hypot(line.arc->first_center, line.arc->second_center);
  return length / speed_of(line.end - line.start, line.feed);
}

// From the line's feed.
double GrblFollower::braking_time(const GrblLineMotion& line) const {
  const Point way = line.end - line.start;
  const Point measured = limits_.measured(way);
  double weakest = std::numeric_limits<double>::infinity();
  for (const Axis axis : all_axes) {
    if (measured[axis] == 0 || limits_.steps_per_mm[axis] <= 0) continue;
    weakest = std::min(weakest, limits_.acceleration[axis].value());
  }
  return std::isinf(weakest) || weakest <= 0 ? 0 : measured_speed(way, line.feed) / weakest;
}

std::vector<std::string> GrblFollower::pieces(const std::string& text) {
  const GrblLineMotion line = added_reader_.read(text);
  const double most = ahead_.value() / 4;
  const double count = std::min(std::ceil(duration_of(line) / most - 1e-9), most_pieces);
  if (line.kind != GrblLineMotion::Kind::move || count <= 1) return {text};
  return line.arc ? arc_pieces(text, line, static_cast<int>(count))
                  : straight_pieces(text, line, static_cast<int>(count));
}

// The words of a place, of the axes that the line names.
std::string GrblFollower::place_words(const std::string& text, const Point& place) const {
  std::string words;
  for (const char letter : text) {
    const auto axis = letter >= 'A' && letter <= 'Z' ? axis_of(letter) : std::nullopt;
    if (axis) words += letter + number_text(place[*axis] - added_reader_.zero()[*axis]);
  }
  return words;
}

std::vector<std::string> GrblFollower::straight_pieces(const std::string& text, const GrblLineMotion& line,
                                                       int count) const {
  const GrblLineModes& modes = added_reader_.modes();
  std::string head = words_without(text, "XYZABCUVW");
  if (modes.by_time) {
    const std::string feed = fmt::format("F{:.6f}", modes.feed * count);
    head = words_without(head, "F") + feed;
  }
  std::vector<std::string> all;
  for (int i = 1; i <= count; ++i) {
    const Point place = line.start + (line.end - line.start) * (static_cast<double>(i) / count);
    const std::string words = i < count ? place_words(text, place) : words_without(text, "GFMSNP");
    all.push_back(head + words);
    if (!modes.by_time) head.clear();
  }
  return all;
}

std::vector<std::string> GrblFollower::arc_pieces(const std::string& text, const GrblLineMotion& line,
                                                  int count) const {
  const GrblPlanner::Arc& arc = *line.arc;
  const double turn = turn_of(line);
  const double radius = std::hypot(arc.first_center, arc.second_center);
  count = std::min(count, std::max(1, static_cast<int>(std::abs(turn) * radius / shortest_chord)));
  if (count <= 1) return {text};
  const double first = line.start[arc.first] + arc.first_center;
  const double second = line.start[arc.second] + arc.second_center;
  const auto rounded = [&](const Point& place, Axis axis) {
    const double zero = added_reader_.zero()[axis];
    return std::round((place[axis] - zero) * 1e4) / 1e4 + zero;
  };
  const auto center_word = [](Axis axis) { return static_cast<char>('I' + static_cast<int>(axis)); };
  std::string head = words_without(text, "XYZIJK");
  std::vector<std::string> all;
  Point from = line.start;
  for (int i = 1; i <= count; ++i) {
    Point place = line.start + (line.end - line.start) * (static_cast<double>(i) / count);
    const double cosine = std::cos(turn * i / count);
    const double sine = std::sin(turn * i / count);
    place[arc.first] = first - arc.first_center * cosine + arc.second_center * sine;
    place[arc.second] = second - arc.first_center * sine - arc.second_center * cosine;
    if (i == count) place = line.end;
    all.push_back(head + place_words("XYZ", place) + center_word(arc.first) +
                  number_text(first - rounded(from, arc.first)) + center_word(arc.second) +
                  number_text(second - rounded(from, arc.second)));
    head.clear();
    from = place;
  }
  return all;
}

bool GrblFollower::may_send(std::string_view text, Seconds now) {
  if (lost_) return true;
  GrblLineReader next = sent_reader_;
  const GrblLineMotion line = next.read(text);
  if (line.kind != GrblLineMotion::Kind::move) return true;
  const double time = duration_of(line);
  const double in_board = time_in_board(now).value();
  if (in_board <= 0) return true;
  if (in_board * clock_.factor <= braking_time(line) + time + response) return true;
  if (in_board + time / clock_.factor > ahead_.value()) return false;
  // What waits for a block is counted at full speed, so the end is added.
  const double with_line =
      waits_in_buffer() ? remaining() + clock_.debt + time + braking_time(line) : time_with(line) + clock_.debt;
  return with_line / clock_.factor <= ahead_.value();
}

// How long the board moves with a further line. Most of the lines are not near the limit.
double GrblFollower::time_with(const GrblLineMotion& line) const {
  GrblPlanner model = model_;
  const auto add = [&](const Point& place) {
    if (!model.full()) model.add_line(place, line.feed, 0, model.now());
  };
  if (line.arc) {
    GrblPlanner::each_chord(*line.arc, line.start, line.end, limits_.arc_tolerance, add);
  } else {
    add(line.end);
  }
  return model.rest_at().value() - clock_.time;
}

Seconds GrblFollower::time_in_board(Seconds now) {
  advance(now);
  return Seconds((remaining() + clock_.debt) / clock_.factor);
}

std::optional<Seconds> GrblFollower::dwell_left(Seconds now) {
  advance(now);
  if (!model_.empty()) return {};
  double left = std::max(0.0, rests_until_ - clock_.time);
  for (const Waiting& one : waiting_) {
    if (!one.rests) break;
    left += one.dwell.value();
  }
  return left > 0 ? std::optional(Seconds(left)) : std::nullopt;
}

double GrblFollower::remaining() const {
  double time = std::max(model_.rest_at().value(), rests_until_) - clock_.time;
  if (time < 0) time = 0;
  for (const Waiting& one : waiting_) time += one.time + one.dwell.value();
  return time;
}

void GrblFollower::sent(std::string_view text, std::uint32_t line, Seconds now) {
  advance(now);
  if (line != 0) last_line_ = line;
  const GrblLineMotion motion = sent_reader_.read(text);
  ends_in_rest_ = motion.kind == GrblLineMotion::Kind::rest;
  switch (motion.kind) {
    case GrblLineMotion::Kind::modes: return;
    case GrblLineMotion::Kind::rest: waiting_.push_back({.rests = true, .dwell = motion.dwell}); break;
    case GrblLineMotion::Kind::unknown: lost_ = true; return;
    case GrblLineMotion::Kind::move:
      if (motion.arc) {
        GrblPlanner::each_chord(*motion.arc, motion.start, motion.end, limits_.arc_tolerance,
                                [&](const Point& place) { add_leg(place, motion.feed, line); });
      } else {
        add_leg(motion.end, motion.feed, line);
      }
      break;
  }
  run_model(clock_.time);
}

void GrblFollower::add_leg(const Point& end, MmPerSecond feed, std::uint32_t line) {
  const Point from = path_.end;
  Leg leg{.from = from, .to = end, .begin = path_.length, .length = length_of(end - from), .line = line};
  leg.speed = speed_of(end - from, feed);
  path_.length += leg.length;
  waiting_.push_back({.end = end,
                      .feed = feed,
                      .leg = path_.first + static_cast<std::uint32_t>(path_.legs.size()),
                      .time = leg.length / leg.speed});
  path_.legs.push_back(leg);
  path_.end = end;
}

void GrblFollower::advance(Seconds now) {
  if (clock_.set < Seconds(0)) clock_.set = now;
  double passed = std::max(0.0, (now - clock_.set).value()) * clock_.factor;
  clock_.set = std::max(clock_.set, now);
  if (clock_.paused) return;
  const double waits = std::min(passed, clock_.debt);
  clock_.debt -= waits;
  run_model(clock_.time + passed - waits);
}

// The model takes what waits as the board does: a line when there is a free block, a rest when nothing moves.
void GrblFollower::run_model(double until) {
  clock_.time = std::max(clock_.time, until);
  for (;;) {
    if (waiting_.empty()) break;
    const Waiting& next = waiting_.front();
    if (next.rests) {
      const double begin = std::max(model_.rest_at().value(), rests_until_);
      if (begin > clock_.time) break;
      model_.wait_for_rest(Seconds(0), Seconds(begin));
      rests_until_ = begin + next.dwell.value();
    } else {
      if (rests_until_ > clock_.time) break;
      if (model_.full()) {
        const Seconds end = model_.first_end();
        if (end.value() > clock_.time) break;
        model_.run(end);
        continue;
      }
      model_.add_line(next.end, next.feed, next.leg, Seconds(std::max(model_.now().value(), rests_until_)));
    }
    waiting_.pop_front();
  }
  model_.run(Seconds(clock_.time));
}

double GrblFollower::model_place() const {
  if (!model_.empty()) {
    const std::uint32_t index = model_.source() - path_.first;
    if (index < path_.legs.size()) return path_.legs[index].begin + model_.done_of_first().value();
    return path_.known;
  }
  for (const Waiting& one : waiting_) {
    if (!one.rests && one.leg - path_.first < path_.legs.size()) return path_.legs[one.leg - path_.first].begin;
  }
  return path_.length;
}

// The place along the path that is nearest to the expected one, of all that are within the tolerance.
std::optional<double> GrblFollower::nearest_on_path(const Point& place, double expected) const {
  std::optional<double> best;
  for (const Leg& leg : path_.legs) {
    const Point way = leg.to - leg.from;
    double along = leg.length > 0 ? dot(place - leg.from, way) / leg.length : 0;
    along = std::clamp(along, 0.0, leg.length);
    const Point foot = leg.length > 0 ? leg.from + way * (along / leg.length) : leg.from;
    if (length_of(place - foot) > tolerance_) continue;
    // All places of the leg within the tolerance are possible.
    const double found = leg.begin + std::clamp(expected - leg.begin, std::max(0.0, along - tolerance_),
                                                std::min(leg.length, along + tolerance_));
    if (!best || std::abs(found - expected) < std::abs(*best - expected)) best = found;
  }
  return best;
}

// The model's clock follows the board.
void GrblFollower::correct(double along, bool rests) {
  path_.known = std::max(path_.known, along);
  const double model = model_place();
  double speed = smallest_speed;
  for (const Leg& leg : path_.legs) {
    if (leg.begin <= along) speed = leg.speed;
  }
  clock_.paused = rests && (!model_.empty() || !waiting_.empty());
  if (along < model) {
    clock_.debt = std::min((model - along) / speed, 1.0);
  } else {
    clock_.debt = 0;
    run_model(clock_.time + std::min((along - model) / speed, 1.0));
  }
  while (path_.legs.size() > 1 && path_.legs.front().begin + path_.legs.front().length < path_.known - kept_behind) {
    path_.legs.pop_front();
    ++path_.first;
  }
}

std::optional<GrblFollower::Trouble> GrblFollower::hear(const Point& place, bool rests, bool ends, Seconds now) {
  advance(now);
  if (lost_ || path_.legs.empty()) return {};
  ends = ends && ends_in_rest_;
  const Leg& last = path_.legs.back();
  const double beside_end = length_of(place - last.to);
  if (const auto along = nearest_on_path(place, model_place()); along && (!ends || beside_end <= tolerance_)) {
    strikes_ = 0;
    correct(*along, rests);
    return {};
  }
  if (++strikes_ < most_strikes && !ends) return {};
  std::string words = ends ? "it has stopped" : "it is";
  double nearest = beside_end;
  if (!ends) {
    for (const Leg& leg : path_.legs) {
      const Point way = leg.to - leg.from;
      const double along = leg.length > 0 ? std::clamp(dot(place - leg.from, way) / leg.length, 0.0, leg.length) : 0;
      const Point foot = leg.length > 0 ? leg.from + way * (along / leg.length) : leg.from;
      nearest = std::min(nearest, length_of(place - foot));
    }
  }
  return Trouble{
      .code = "grbl.off-path",
      .message = fmt::format("the machine does not move as the program says: {} {:.3f} mm beside its path. A "
                             "line was lost or changed on the way to it, or another program moves it",
                             words, nearest),
      .first_line = first_line(),
      .last_line = last_line_};
}

Seconds GrblFollower::longest_between_changes() const {
  double slowest = std::numeric_limits<double>::infinity();
  for (const Leg& leg : path_.legs) {
    if (leg.begin + leg.length >= path_.known) slowest = std::min(slowest, leg.speed);
  }
  return Seconds(std::isinf(slowest) ? 0 : report_resolution / (slowest * clock_.factor));
}

std::uint32_t GrblFollower::first_line() const {
  for (const Leg& leg : path_.legs) {
    if (leg.line != 0 && leg.begin + leg.length >= path_.known) return leg.line;
  }
  return last_line_;
}

std::optional<GrblFollower::Trouble> GrblFollower::check_modes(std::string_view modes, const GrblLineModes& expected,
                                                               bool in_inches) const {
  if (lost_) return {};
  std::string wrong;
  const auto compare = [&](bool differs, std::string_view told, const std::string& wanted) {
    if (differs && wrong.empty()) wrong = fmt::format("it is in {} instead of {}", told, wanted);
  };
  while (!modes.empty()) {
    const std::string_view mode = next_grbl_field(modes, ' ');
    if (mode.size() < 2) continue;
    const auto value = read_grbl_number(mode.substr(1));
    if (!value) continue;
    const bool is_motion = mode[0] == 'G' && *value >= 0 && *value <= 3;
    compare(is_motion && expected.motion >= 0 && *value != expected.motion, mode, fmt::format("G{}", expected.motion));
    const bool is_plane = mode[0] == 'G' && *value >= 17 && *value <= 19;
    compare(is_plane && *value != expected.plane, mode, fmt::format("G{}", expected.plane));
    const bool is_spindle = mode[0] == 'M' && *value >= 3 && *value <= 5;
    compare(is_spindle && expected.spindle >= 0 && *value != expected.spindle, mode,
            fmt::format("M{}", expected.spindle));
    const bool knows_feed = mode[0] == 'F' && expected.feed >= 0 && !expected.by_time;
    const double unit = in_inches ? mm_per_inch : 1;
    // FluidNC reports F in millimetres even if everything else is in inches.
    const double beside = std::min(std::abs(*value * unit - expected.feed) / unit, std::abs(*value - expected.feed));
    compare(knows_feed && beside > 0.51, mode, fmt::format("F{:.0f}", expected.feed / unit));
    const bool knows_speed = mode[0] == 'S' && expected.speed >= 0;
    compare(knows_speed && std::abs(*value - expected.speed) > 0.51, mode, fmt::format("S{:.0f}", expected.speed));
  }
  if (wrong.empty()) return {};
  return Trouble{.code = "grbl.changed-line",
                 .message = "a line was changed on the way to the machine: " + wrong,
                 .first_line = first_line(),
                 .last_line = last_line_};
}

}  // namespace passo
