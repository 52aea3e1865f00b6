// The main program of StrictGrbl: reads lines, and executes each in parts that may have to wait.
#pragma once

#include <charconv>
#include <cmath>
#include <numbers>

#include "kit/strict_grbl.hpp"

namespace passo {

inline void StrictGrbl::work() {
  for (;;) {
    if (boots_ || halted_ || now_ < stalls_until_) return;
    do_real_time();
    if (suspended()) return;
    if (!tasks_.empty()) {
      const unsigned resets = resets_;
      if (!run_task(Task(tasks_.front()))) return;
      if (resets == resets_) tasks_.pop_front();
      continue;
    }
    const bool takes_lines =
        state == "Idle" || state == "Run" || state == "Jog" || state == "Alarm" || state == "Check";
    if (!takes_lines) return;
    if (read_line()) continue;
    start_cycle();
    return;
  }
}

// Returns whether there was a whole line.
inline bool StrictGrbl::read_line() {
  for (std::size_t at = 0; at < ring_.size(); ++at) {
    char byte = ring_[at];
    if (byte == '\n' || byte == '\r') {
      ring_.erase(0, at + 1);
      const bool overflows = std::exchange(line_overflows_, false);
      comment_ = 0;
      const std::string line = std::exchange(line_, {});
      if (overflows) {
        answer(11);
      } else {
        take_line(line);
      }
      return true;
    }
    if (comment_ != 0 || line_overflows_) {
      if (byte == ')' && comment_ == '(') comment_ = 0;
    } else if (byte == '(' || byte == ';') {
      comment_ = byte;
    } else if (byte > ' ' && byte != '/') {
      if (byte >= 'a' && byte <= 'z') byte = static_cast<char>(byte - 'a' + 'A');
      if (line_.size() < longest_line) {
        line_ += byte;
      } else {
        line_overflows_ = true;
      }
    }
  }
  ring_.clear();
  return false;
}

inline void StrictGrbl::take_line(const std::string& line) {
  int error = 0;
  if (line.starts_with('$')) {
    error = take_command(line);
  } else if (line.empty()) {
    return answer(0);
  } else if (is("Alarm") || is("Jog")) {
    error = 9;
  } else if (line == refused) {
    error = 20;
  } else {
    error = add_gcode(line, false);
  }
  if (error >= 0) add_task(Task::Kind::answer, error);
}

// Returns the number of the error; -1: there is no answer.
inline int StrictGrbl::take_command(const std::string& line) {
  const char kind = line.size() > 1 ? line[1] : '\0';
  if (kind == '\0') {
    say("[HLP:$$ $# $G $I $N $x=val $Nx=line $J=line $SLP $C $X $H ~ ! ? ctrl-x]");
    return 0;
  }
  if (kind == 'J') {
    if (state != "Idle" && state != "Jog") return 8;
    return line.size() < 3 || line[2] != '=' ? 3 : add_gcode(line, true);
  }
  if (kind != '$' && kind != 'G' && kind != 'C' && kind != 'X') return take_idle_command(line);
  if (line.size() > 2) return 3;
  if (kind == '$') {
    if (is("Run") || is("Hold")) return 8;
    add_reply(settings.empty() ? values_.text() : settings);
  } else if (kind == 'G') {
    say_modes();
  } else if (kind == 'C' && is("Check")) {
    say("[MSG:Disabled]");
    answer(0);
    add_task(Task::Kind::reset);
    return -1;
  } else if (kind == 'C') {
    if (state != "Idle") return 8;
    state = "Check";
    say("[MSG:Enabled]");
  } else if (is("Alarm")) {
    if (door_is_open_) return 13;
    say("[MSG:Caution: Unlocked]");
    state = "Idle";
  }
  return 0;
}

inline int StrictGrbl::take_idle_command(const std::string& line) {
  if (state != "Idle" && !is("Alarm")) return 8;
  switch (line[1]) {
    case '#':
      if (line.size() > 2) return 3;
      say_offsets();
      return 0;
    case 'H': {
      if (values_[22] == 0) return 5;
      if (door_is_open_) return 13;
      const bool one = line.size() == 3 && options.substr(0, options.find(',')).find('H') != std::string::npos;
      if (line.size() > 2 && (!one || axes.find(line[2]) == std::string::npos)) return 3;
      state = "Home";
      homes_until_ = homes_for_ever ? never : now_ + homing_time;
      add_task(Task::Kind::home, line.size() > 2 ? line[2] : 0);
      return 0;
    }
    case 'S':
      if (line != "$SLP") return 3;
      answer(0);
      add_task(Task::Kind::sleep);
      return -1;
    case 'I':
      if (line.size() > 2) return 3;
      say("[VER:" + version + "]");
      say("[OPT:" + options + "]");
      add_reply(more_of_itself);
      return 0;
    case 'R':
      if (line != "$RST=$" && line != "$RST=#" && line != "$RST=*") return 3;
      if (line[5] != '#') values_ = GrblBoardSettings(axes.size());
      if (line[5] != '$') modes_.systems = {};
      if (line[5] != '$') modes_.g28 = modes_.g30 = {};
      use_settings();
      say("[MSG:Restoring defaults]");
      answer(0);
      add_task(Task::Kind::reset);
      return -1;
    case 'N':
      if (line.size() > 2) return store_startup_line(line);
      for (std::size_t i = 0; i < startup_lines_.size(); ++i) say(fmt::format("$N{}={}", i, startup_lines_[i]));
      return 0;
    default: return store_setting(line);
  }
}

inline int StrictGrbl::store_setting(const std::string& line) {
  double number = 0;
  double value = 0;
  const char* const end = line.data() + line.size();
  const auto name = std::from_chars(line.data() + 1, end, number);
  if (name.ec != std::errc()) return 2;
  if (name.ptr == end || *name.ptr != '=') return 3;
  const auto text = std::from_chars(name.ptr + 1, end, value);
  if (text.ec != std::errc()) return 2;
  if (text.ptr != end) return 3;
  const int error = values_.store(number, value);
  if (error != 0) return error;
  use_settings();
  add_task(Task::Kind::store, 0, byte_of_eeprom * static_cast<double>(values_.changed()));
  return 0;
}

inline int StrictGrbl::store_startup_line(const std::string& line) {
  if (state != "Idle") return 8;
  if (line[2] != '0' && line[2] != '1') return 3;
  if (line.size() < 4 || line[3] != '=') return 3;
  const std::string text = line.substr(4);
  const int error = text.empty() ? 0 : add_gcode(text, false);
  if (error != 0) return error;
  startup_lines_[static_cast<std::size_t>(line[2] - '0')] = text;
  add_task(Task::Kind::store, 0, byte_of_eeprom * static_cast<double>(text.size() + 2));
  return 0;
}

inline int StrictGrbl::add_gcode(const std::string& line, bool jog) {
  GrblBoardBlock block;
  const int error = parser_.parse(jog ? std::string_view(line).substr(3) : line, jog, modes_, block);
  if (error != 0) return error;
  if (jog && values_[20] != 0 && leaves_travel(block.end)) return 15;
  pending_ = block.after;
  const bool moves = !is("Check");
  if (moves && block.changes_outputs) {
    add_task(Task::Kind::rest);
    add_task(Task::Kind::outputs);
    if (block.after.spindle != 5 && spindle_time > 0) add_task(Task::Kind::dwell, 0, spindle_time);
  }
  if (moves && block.dwell) {
    add_task(Task::Kind::rest);
    add_task(Task::Kind::dwell, 0, *block.dwell);
    done_.push_back(line);
  }
  if (moves && (block.changes_zero || block.stored_bytes > 0)) add_task(Task::Kind::rest);
  if (block.stored_bytes > 0) {
    add_task(Task::Kind::store, 0, byte_of_eeprom * static_cast<double>(block.stored_bytes + 1));
  }
  if (moves) add_moves(block, line, jog);
  add_task(Task::Kind::apply, block.changes_zero ? 1 : 0);
  if (block.flow >= 0) {
    if (moves) add_task(Task::Kind::rest);
    if (moves || block.flow != 0) add_task(block.flow == 0 ? Task::Kind::pause : Task::Kind::end);
  }
  return 0;
}

inline bool StrictGrbl::leaves_travel(const Point& end) const {
  for (const char letter : axes) {
    const double travel = values_[130 + static_cast<int>(axes.find(letter))];
    const double place = end[*axis_of(letter)];
    if (place > 0 || place < -travel) return true;
  }
  return false;
}

inline void StrictGrbl::add_moves(const GrblBoardBlock& block, const std::string& line, bool jog) {
  if (block.move && *block.move >= 382) {
    add_task(Task::Kind::rest);
    tasks_.push_back({.kind = Task::Kind::probe,
                      .move = {.end = block.end, .feed = block.feed / 60, .fixed_feed = true},
                      .number = *block.move});
    return;
  }
  std::vector<GrblBoardMotion::Move> moves;
  constexpr double rapid = never;
  double feed = block.feed / 60;
  if (block.inverse_time && block.move) {
    const Point way = block.end - modes_.position;
    double length2 = 0;
    for (const double part : way.values) length2 += part * part;
    feed *= std::sqrt(length2);
  }
  if (block.move == 2 || block.move == 3) {
    add_arc(block, feed, moves);
  } else if (block.move) {
    moves.push_back({.end = block.end, .feed = *block.move == 0 && !jog ? rapid : feed});
  }
  if (block.home) moves.push_back({.end = *block.home, .feed = rapid});
  for (GrblBoardMotion::Move& move : moves) {
    move.number = block.number;
    if (&move == &moves.back() && !jog) move.line = line;
    if (!jog && values_[20] != 0 && leaves_travel(move.end)) return add_task(Task::Kind::soft_limit);
    tasks_.push_back({.kind = jog ? Task::Kind::jog : Task::Kind::move, .move = std::move(move)});
  }
}

inline void StrictGrbl::add_arc(const GrblBoardBlock& block, double feed,
                                std::vector<GrblBoardMotion::Move>& moves) const {
  const Point start = modes_.position;
  const double first = block.center[block.first];
  const double second = block.center[block.second];
  const double to_first = block.end[block.first] - start[block.first] - first;
  const double to_second = block.end[block.second] - start[block.second] - second;
  const double radius = std::hypot(first, second);
  double turn = std::atan2(-first * to_second + second * to_first, -first * to_first - second * to_second);
  constexpr double same_angle = 5e-7;
  const bool clockwise = block.move == 2;
  if (clockwise && turn >= -same_angle) turn -= 2 * std::numbers::pi;
  if (!clockwise && turn <= same_angle) turn += 2 * std::numbers::pi;
  const double tolerance = values_[12];
  const double chord = std::sqrt(std::max(1e-12, tolerance * (2 * radius - tolerance)));
  const double count = std::floor(std::abs(turn * radius) / 2 / chord);
  for (double i = 1; i < count; ++i) {
    Point place = start + (block.end - start) * (i / count);
    const double cosine = std::cos(turn * i / count);
    const double sine = std::sin(turn * i / count);
    place[block.first] = start[block.first] + first - first * cosine + second * sine;
    place[block.second] = start[block.second] + second - first * sine - second * cosine;
    moves.push_back({.end = place, .feed = feed});
  }
  moves.push_back({.end = block.end, .feed = feed});
}

// Returns whether it is done.
inline bool StrictGrbl::run_task(const Task& task) {
  switch (task.kind) {
    case Task::Kind::move:
    case Task::Kind::jog:
      if (motion_.full()) {
        start_cycle();
        return false;
      }
      motion_.add(task.move);
      if (task.kind == Task::Kind::move || state != "Idle" || motion_.empty()) return true;
      state = "Jog";
      motion_.start();
      return true;
    case Task::Kind::rest: start_cycle(); return motion_.empty() && state != "Run";
    case Task::Kind::outputs:
      spindle_ = pending_.spindle;
      spindle_speed_ = pending_.speed;
      flood_ = pending_.flood;
      mist_ = pending_.mist;
      override_count_ = 0;
      return true;
    case Task::Kind::dwell:
      if (!std::exchange(dwells_, true)) dwell_left_ = task.time;
      if (dwell_left_ > 0) return false;
      dwells_ = false;
      return true;
    case Task::Kind::store:
      stalls_until_ = now_ + task.time;
      stall_part_ = -1;
      return true;
    case Task::Kind::apply:
      modes_ = pending_;
      if (task.number != 0) offset_count_ = 0;
      return true;
    case Task::Kind::soft_limit:
      if (state == "Run" || state == "Idle") {
        start_cycle();
        motion_.brake();
      }
      if (motion_.moves()) return false;
      halt(2);
      answers_at_reset_ = true;
      return true;
    case Task::Kind::probe: return run_probe(task);
    case Task::Kind::home: return run_home(task);
    case Task::Kind::pause: state = "Hold:0"; return true;
    case Task::Kind::end: {
      const bool checks = is("Check");
      modes_.motion = 1;
      modes_.plane = 17;
      modes_.distance = 90;
      modes_.feed_mode = 94;
      modes_.system = 54;
      modes_.spindle = 5;
      modes_.flood = modes_.mist = false;
      if (!checks) {
        spindle_ = 5;
        flood_ = mist_ = false;
        offset_count_ = 0;
      }
      feed_override_ = rapid_override_ = spindle_override_ = 100;
      motion_.set_overrides(1, 1);
      say("[MSG:Pgm End]");
      return true;
    }
    case Task::Kind::reset: reset(); return true;
    case Task::Kind::sleep:
      state = "Sleep";
      say("[MSG:Sleeping]");
      return true;
    case Task::Kind::answer: answer(task.number); return true;
  }
  return true;
}

inline bool StrictGrbl::run_probe(const Task& task) {
  const bool away = task.number >= 384;
  const bool silently = task.number == 383 || task.number == 385;
  if (!probes_) {
    if (probe && probe(motion_.place()) != away) {
      state = "Alarm";
      say("ALARM:4");
      pending_.position = modes_.position;
      return true;
    }
    probes_ = true;
    touched_ = false;
    probes_for_touch_ = !away;
    motion_.add(task.move);
    start_cycle();
  }
  if (motion_.moves()) return false;
  probes_ = false;
  motion_.drop();
  state = touched_ || silently ? "Idle" : "Alarm";
  if (!touched_ && silently) probed_ = motion_.place();
  probe_succeeded_ = touched_;
  if (!touched_ && !silently) say("ALARM:5");
  say("[PRB:" + places(probed_) + (probe_succeeded_ ? ":1]" : ":0]"));
  pending_.position = motion_.place();
  return true;
}

inline bool StrictGrbl::run_home(const Task& task) {
  if (now_ < homes_until_) return false;
  homes_until_ = 0;
  if (!has_switches) {
    drop_work();
    state = "Alarm";
    say("ALARM:9");
    greet();
    return true;
  }
  Point place = motion_.place();
  for (const char letter : axes) {
    if (task.number != 0 && letter != static_cast<char>(task.number)) continue;
    const int index = static_cast<int>(axes.find(letter));
    const bool down = (static_cast<unsigned>(values_[23]) >> static_cast<unsigned>(index) & 1U) != 0;
    place[*axis_of(letter)] = down ? values_[27] - values_[130 + index] : -values_[27];
  }
  motion_.set_place(place);
  modes_.position = place;
  state = "Idle";
  if (task.number == 0) run_startup_lines();
  return true;
}

inline void StrictGrbl::run_startup_lines() {
  for (const std::string& line : startup_lines_) {
    if (line.empty()) continue;
    const int error = add_gcode(line, false);
    say(">" + line + (error == 0 ? ":ok" : fmt::format(":error:{}", error)));
  }
}

inline void StrictGrbl::greet() {
  add_reply("\r\n" + greeting + "\r\n");
  if (state == "Alarm") return say("[MSG:'$H'|'$X' to unlock]");
  asks_door_ = door_is_open_;
  run_startup_lines();
}

// What a reset forgets.
inline void StrictGrbl::drop_work() {
  waits_for_start_ = false;
  ++resets_;
  ring_.clear();
  line_.clear();
  line_overflows_ = false;
  comment_ = 0;
  tasks_.clear();
  motion_.drop();
  GrblBoardModes fresh;
  fresh.systems = modes_.systems;
  fresh.g28 = modes_.g28;
  fresh.g30 = modes_.g30;
  fresh.position = motion_.place();
  modes_ = fresh;
  asks_hold_ = asks_start_ = asks_door_ = asks_cancel_ = false;
  asked_overrides_.clear();
  halted_ = cancels_jog_ = door_after_jog_ = probes_ = dwells_ = asks_report_ = false;
  restores_coolant_ = false;
  dwell_left_ = stalls_until_ = homes_until_ = restores_until_ = 0;
  feed_override_ = rapid_override_ = spindle_override_ = 100;
  motion_.set_overrides(1, 1);
  spindle_ = 5;
  flood_ = mist_ = false;
  probed_ = {};
  probe_succeeded_ = false;
  offset_count_ = override_count_ = 0;
}

inline void StrictGrbl::use_settings() {
  parser_.axes = axes;
  for (int i = 0; i < static_cast<int>(axes.size()); ++i) {
    const Axis axis = *axis_of(axes[static_cast<std::size_t>(i)]);
    limits_.steps_per_mm[axis] = values_[100 + i];
    limits_.velocity[axis] = values_[110 + i] / 60;
    limits_.acceleration[axis] = values_[120 + i];
  }
  limits_.junction_deviation = values_[11];
  limits_.block_time = block_time;
  used_options_ = options;
  std::string_view rest = options;
  rest = rest.substr(std::min(rest.find(','), rest.size()));
  int blocks = 0;
  if (!rest.empty() && std::from_chars(rest.data() + 1, rest.data() + rest.size(), blocks).ec == std::errc()) {
    limits_.blocks = static_cast<std::size_t>(std::max(1, blocks));
  }
  motion_.set_limits(limits_);
}

}  // namespace passo

#include "kit/strict_grbl_reports.hpp"
