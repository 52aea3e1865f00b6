// StrictGrbl: a machine with Grbl 1.1 in virtual time, as its sources and the real one behave:
// - the receive buffer loses bytes on overflow, and while the EEPROM is written;
// - real-time bytes act in the middle of lines, `$` commands mostly in Idle, G-code neither in an alarm nor in a jog;
// - motion takes its time: GrblBoardMotion plans it; holds brake; a reset while moving is ALARM:3;
// - alarms, check mode, sleep, door, jogs and their cancellation, probing, homing, overrides, power cuts;
// - reports carry WCO and Ov in Grbl's turns.
// tests/kit/grbl_conversations.hpp holds it against the real ones. Its public variables script what Grbl alone does
// not do: other firmware, a line that is refused, a machine that is silent.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kit/grbl_board_motion.hpp"
#include "kit/grbl_board_parser.hpp"
#include "kit/grbl_board_settings.hpp"
#include <fmt/format.h>

namespace passo {

class StrictGrbl {
 public:
  explicit StrictGrbl(std::size_t bytes = 128) : bytes_(bytes) { use_settings(); }

  // What it says of itself; an empty text is Grbl's own.
  std::string greeting = "Grbl 1.1h ['$' for help]";
  std::string version = "1.1h.20190830:";
  std::string options = "V,15,128";
  std::string more_of_itself = {};               // whole lines sent after the options
  std::string settings = {};                     // the answer to $$
  std::string offsets = {};                      // the answer to $#
  std::string modes = {};                        // the modes in the answer to $G
  std::function<std::string()> own_report = {};  // generates reports in another format
  // What it is made of.
  std::string axes = "XYZ";  // takes effect with restart()
  bool line_numbers = false;
  bool has_switches = true;                      // whether there are limit switches for $H
  double homing_time = 0;                        // s
  std::function<bool(const Point&)> probe = {};  // whether the probe touches at a machine position
  double bytes_per_second = 0;                   // of the line, in both directions; 0: without limit
  double block_time = 0;                         // duration of each motion, s; 0: as it plans it
  double spindle_time = 0;                       // duration of M3, s
  double boot_time = 0;                          // after a reset of the chip, s; bytes are lost meanwhile
  // Accidents.
  bool homes_for_ever = false;
  std::string refused = {};  // a line that gets error:20
  std::string trips = {};    // a line at which a limit switch closes
  bool loses_next_line_end = false;
  bool silent = false;  // does not report
  bool ignores_hold_at_rest = false;
  bool held_input = false;             // the hold input is active
  bool second_cancel_is_late = false;  // it meets the end of the jog

  std::string state = "Idle";  // as reported, with its number
  double x = 0;                // place()[Axis::x]

  std::size_t most_waiting() const { return most_waiting_; }
  bool overflowed() const { return overflowed_; }
  std::size_t lost_bytes() const { return lost_bytes_; }
  // Lines whose motion has ended.
  const std::deque<std::string>& done() const { return done_; }
  std::string take_output() { return std::exchange(output_, {}); }
  Point place() const { return motion_.place(); }
  double speed() const { return motion_.speed(); }  // mm/s
  double now() const { return now_; }
  std::size_t blocks_held() const { return blocks() - motion_.free_blocks(); }
  std::size_t bytes_held() const { return ring_.size(); }
  const GrblBoardModes& parser_modes() const { return modes_; }
  const GrblBoardSettings& values() const { return values_; }

  // Puts a setting into the EEPROM, as if it had been there always.
  void put(int number, double value) {
    values_.put(number, value);
    use_settings();
  }
  // Resets the chip, as by its button, by DTR, or by the power: the position is lost.
  void restart() {
    drop_work();
    motion_.set_place({});
    values_.use_axes(axes.size());
    use_settings();
    wire_.clear();
    replies_.clear();
    output_.clear();
    state = values_[22] != 0 ? "Alarm" : "Idle";
    boots_until_ = now_ + boot_time;
    boots_ = true;
    if (boot_time <= 0) end_boot();
  }
  void open_door(bool open) {
    door_is_open_ = open;
    asks_door_ = asks_door_ || open;
    if (!open && state == "Door:1") state = "Door:0";
  }
  // With hard limits ($21) a switch that closes stops the machine at once.
  void set_limit(char axis, bool closed) {
    std::erase(closed_limits_, axis);
    if (!closed) return;
    closed_limits_ += axis;
    if (values_[21] != 0 && !is("Alarm") && !is("Home")) halt(1);
  }
  void say(const std::string& line) { add_reply(line + "\r\n"); }
  // Goes on after a state that a test has set.
  void resume() {
    state = motion_.empty() ? "Idle" : "Run";
    motion_.start();
  }

  void receive(std::string_view bytes) {
    if (bytes_per_second <= 0) {
      for (const char byte : bytes) arrive(byte);
      return flush();
    }
    if (wire_.empty()) next_byte_ = std::max(next_byte_, now_ + 1 / bytes_per_second);
    wire_.insert(wire_.end(), bytes.begin(), bytes.end());
  }
  // Advances the time.
  void run(double seconds) {
    const double end = now_ + seconds;
    if (block_time != limits_.block_time || options != used_options_) use_settings();
    for (int round = 0; round < most_rounds; ++round) {
      work();
      const double next = std::min(end, next_event());
      advance(std::max(next, now_));
      if (next >= end) break;
    }
    work();
    now_ = end;
    flush();
  }

 private:
  static constexpr int most_rounds = 100000;
  static constexpr double never = std::numeric_limits<double>::infinity();
  static constexpr double byte_of_eeprom = 0.0034;  // s
  static constexpr double look_at_probe = 0.0001;   // s
  static constexpr double door_spindle_time = 4;    // s
  static constexpr double door_coolant_time = 1;    // s
  static constexpr std::size_t longest_line = 79;

  // A part of a line that may have to wait.
  struct Task {
    enum class Kind : std::uint8_t {
      move,
      jog,
      rest,
      outputs,
      dwell,
      store,
      apply,
      soft_limit,
      probe,
      home,
      pause,
      end,
      reset,
      sleep,
      answer
    };
    Kind kind;
    GrblBoardMotion::Move move = {};
    double time = 0;
    int number = 0;
  };

  bool is(std::string_view name) const {
    return state.starts_with(name) && (state.size() == name.size() || state[name.size()] == ':');
  }
  bool may_move() const { return is("Run") || is("Jog") || state == "Hold:1" || state == "Door:2"; }
  bool suspended() const { return is("Hold") || is("Door") || is("Sleep") || cancels_jog_ || waits_for_start_; }
  std::size_t blocks() const { return limits_.blocks; }

  // The line. -----------------------------------------------------------------------------------------------------
  void arrive(char byte) {
    if (boots_ || (now_ < stalls_until_ && !survives_stall())) {
      ++lost_bytes_;
      return;
    }
    if (take_real_time(byte)) return;
    if (byte == '\n' && std::exchange(loses_next_line_end, false)) return;
    if (ring_.size() >= bytes_) {
      overflowed_ = true;
      ++lost_bytes_;
      return;
    }
    ring_ += byte;
    most_waiting_ = std::max(most_waiting_, ring_.size());
  }
  // The chip keeps two bytes for each byte of the EEPROM that is written, during which no interrupt is served.
  bool survives_stall() {
    const double part = std::floor((stalls_until_ - now_) / byte_of_eeprom);
    if (part != stall_part_) kept_in_stall_ = 0;
    stall_part_ = part;
    return ++kept_in_stall_ <= 2;
  }
  void add_reply(const std::string& text) {
    if (replies_.empty() && bytes_per_second > 0) next_reply_ = std::max(next_reply_, now_ + 1 / bytes_per_second);
    replies_ += text;
  }
  void flush() {
    if (bytes_per_second <= 0) {
      output_ += std::exchange(replies_, {});
      return;
    }
    if (replies_.empty() || now_ < next_reply_) return;
    const double ready = std::floor((now_ - next_reply_) * bytes_per_second + 1e-9) + 1;
    const std::size_t count = std::min(replies_.size(), static_cast<std::size_t>(ready));
    output_ += replies_.substr(0, count);
    replies_.erase(0, count);
    next_reply_ += static_cast<double>(count) / bytes_per_second;
  }

  // Real-time commands. -------------------------------------------------------------------------------------------
  bool take_real_time(char byte) {
    switch (static_cast<unsigned char>(byte)) {
      case '?': asks_report_ = true; return true;
      case '!': asks_hold_ = true; return true;
      case '~': asks_start_ = true; return true;
      case 0x18: reset(); return true;
      case 0x84: asks_door_ = true; return true;
      case 0x85: take_cancel(); return true;
      default: break;
    }
    const auto code = static_cast<unsigned char>(byte);
    if (code < 0x80) return false;
    if (std::ranges::find(asked_overrides_, code) == asked_overrides_.end()) asked_overrides_.push_back(code);
    return true;
  }
  // What was asked since the last time, each once, however often it was asked.
  void do_real_time() {
    if (asks_report_ && !is("Home")) {
      asks_report_ = false;
      if (!silent) report();
    }
    const bool holds = asks_hold_ || asks_door_ || asks_cancel_;
    if (std::exchange(asks_cancel_, false) && state == "Jog") cancel_jog();
    if (std::exchange(asks_hold_, false)) hold();
    if (std::exchange(asks_door_, false)) enter_door();
    if (std::exchange(asks_start_, false) && !holds) go_on();
    for (const unsigned char code : std::exchange(asked_overrides_, {})) take_override(code);
  }
  void hold() {
    if (state == "Jog") return cancel_jog();
    if (state == "Idle" && !ignores_hold_at_rest) state = "Hold:0";
    if (state != "Run") return;
    state = motion_.moves() ? "Hold:1" : "Hold:0";
    motion_.brake();
  }
  // A cancel that is noted while the machine jogs, and is executed when it is idle: no line is executed until a cycle
  // start.
  void take_cancel() {
    asks_cancel_ = state == "Jog";
    waits_for_start_ = waits_for_start_ || (second_cancel_is_late && cancels_jog_);
  }
  void cancel_jog() {
    cancels_jog_ = true;
    motion_.brake();
  }
  void go_on() {
    if (state == "Idle") waits_for_start_ = false;
    if (state == "Hold:0") {
      if (spindle_ != modes_.spindle) stop_spindle();
      return resume();
    }
    if (state != "Door:0") return;
    state = "Door:3";
    override_count_ = 0;
    spindle_ = modes_.spindle;
    restores_coolant_ = modes_.flood || modes_.mist;
    restores_until_ = now_ + (spindle_ != 5 ? door_spindle_time : 0);
  }
  void enter_door() {
    if (halted_ || is("Alarm") || is("Check") || is("Sleep") || is("Home")) return;
    say("[MSG:Check Door]");
    if (state == "Jog") cancel_jog();
    if (cancels_jog_) {
      door_after_jog_ = true;
      return;
    }
    const bool moves = motion_.moves();
    motion_.brake();
    state = moves ? "Door:2" : door_is_open_ ? "Door:1" : "Door:0";
    if (!moves) switch_off();
  }
  void reset() {
    const bool homes = is("Home");
    const bool loses_place = homes || is("Run") || is("Jog") || state == "Hold:1" || state == "Door:2";
    if (std::exchange(answers_at_reset_, false)) answer(0);
    if (loses_place) say(homes ? "ALARM:6" : "ALARM:3");
    const bool locks = loses_place || is("Alarm") || is("Sleep");
    drop_work();
    state = locks ? "Alarm" : "Idle";
    greet();
  }
  void take_override(unsigned char code) {
    const int feed = stepped(feed_override_, code - 0x90, 10, 200);
    int rapid = rapid_override_;
    if (code == 0x95) rapid = 100;
    if (code == 0x96) rapid = 50;
    if (code == 0x97) rapid = 25;
    const int spindle = stepped(spindle_override_, code - 0x99, 10, 200);
    if (feed != feed_override_ || rapid != rapid_override_ || spindle != spindle_override_) override_count_ = 0;
    feed_override_ = feed;
    rapid_override_ = rapid;
    spindle_override_ = spindle;
    motion_.set_overrides(feed / 100.0, rapid / 100.0);
    const bool may_switch = state == "Idle" || is("Run") || is("Hold") || is("Jog");
    if (code == 0x9E && state == "Hold:0") stop_spindle();
    if (!may_switch || (code != 0xA0 && code != 0xA1)) return;
    if (code == 0xA0) modes_.flood = flood_ = !modes_.flood;
    if (code == 0xA1 && parser_.has_mist) modes_.mist = mist_ = !modes_.mist;
    override_count_ = 0;
  }
  void stop_spindle();
  void switch_off();
  void go_on_after_door();
  // The commands of an override: 100 %, 10 % up, 10 % down, 1 % up, 1 % down.
  static int stepped(int now, int command, int least, int most) {
    constexpr std::array steps = {0, 10, -10, 1, -1};
    if (command < 0 || command > 4) return now;
    return command == 0 ? 100 : std::clamp(now + steps[static_cast<std::size_t>(command)], least, most);
  }

  // Time. ---------------------------------------------------------------------------------------------------------
  double next_event() const {
    double next = may_move() ? now_ + motion_.next_event() : never;
    if (probes_ && motion_.moves()) next = std::min(next, now_ + look_at_probe);
    if (dwell_left_ > 0 && !suspended()) next = std::min(next, now_ + dwell_left_);
    for (const double time : {stalls_until_, homes_until_, restores_until_, boots_ ? boots_until_ : 0}) {
      if (time > now_) next = std::min(next, time);
    }
    return wire_.empty() ? next : std::min(next, next_byte_);
  }
  void advance(double time) {
    const double passed = time - now_;
    now_ = time;
    if (may_move()) motion_.advance(passed);
    x = motion_.place()[Axis::x];
    if (dwell_left_ > 0 && !suspended()) dwell_left_ = dwell_left_ - passed < 1e-9 ? 0 : dwell_left_ - passed;
    if (probes_ && motion_.moves() && !touched_ && probe && probe(motion_.place()) == probes_for_touch_) touch();
    for (std::string& line : motion_.take_done()) end_line(std::move(line));
    settle();
    if (boots_ && now_ >= boots_until_) end_boot();
    if (state == "Door:3" && now_ >= restores_until_) go_on_after_door();
    while (!wire_.empty() && next_byte_ <= now_ + 1e-12) {
      const char byte = wire_.front();
      wire_.pop_front();
      next_byte_ += 1 / bytes_per_second;
      arrive(byte);
    }
  }
  void touch() {
    touched_ = true;
    probed_ = motion_.place();
    motion_.brake();
  }
  void end_line(std::string line) {
    const bool trip = line == trips && !trips.empty();
    done_.push_back(std::move(line));
    if (trip) halt(1);
  }
  // A critical alarm: only a reset is heard after it.
  void halt(int alarm) {
    drop_work();
    state = "Alarm";
    halted_ = true;
    say(fmt::format("ALARM:{}", alarm));
    say("[MSG:Reset to continue]");
  }
  void settle() {
    if (motion_.moves()) return;
    if (cancels_jog_) {
      motion_.drop();
      modes_.position = motion_.place();
      cancels_jog_ = false;
      state = "Idle";
      if (std::exchange(door_after_jog_, false)) {
        state = door_is_open_ ? "Door:1" : "Door:0";
        switch_off();
      }
    }
    if ((state == "Run" || state == "Jog") && motion_.empty()) state = "Idle";
    if (state == "Hold:1") state = "Hold:0";
    if (state != "Door:2") return;
    state = door_is_open_ ? "Door:1" : "Door:0";
    switch_off();
  }

  // The main program, in kit/strict_grbl_lines.hpp. -----------------------------------------------------------------
  void work();
  bool read_line();
  void take_line(const std::string& line);
  int take_command(const std::string& line);
  int take_idle_command(const std::string& line);
  int store_setting(const std::string& line);
  int store_startup_line(const std::string& line);
  int add_gcode(const std::string& line, bool jog);
  void add_moves(const GrblBoardBlock& block, const std::string& line, bool jog);
  void add_arc(const GrblBoardBlock& block, double feed, std::vector<GrblBoardMotion::Move>& moves) const;
  bool leaves_travel(const Point& end) const;
  bool run_task(const Task& task);
  bool run_probe(const Task& task);
  bool run_home(const Task& task);
  void end_home(const Task& task);
  void add_task(Task::Kind kind, int number = 0, double time = 0) {
    tasks_.push_back({.kind = kind, .time = time, .number = number});
  }
  void answer(int error) { say(error == 0 ? "ok" : fmt::format("error:{}", error)); }
  void start_cycle() {
    if (state != "Idle" || motion_.empty()) return;
    state = "Run";
    motion_.start();
  }
  void greet();
  void end_boot() {
    boots_ = false;
    greet();
  }
  void run_startup_lines();
  void drop_work();
  void use_settings();
  void report();
  std::string places(const Point& place) const;
  std::string rate(double mm_per_minute) const;
  void say_offsets();
  void say_modes();

  std::size_t bytes_;
  std::string ring_;  // the receive buffer
  std::string line_;  // the part of a line that the main program has read
  bool line_overflows_ = false;
  char comment_ = 0;
  std::deque<char> wire_;  // bytes on their way to it
  double next_byte_ = 0;
  std::string replies_;  // bytes on their way from it
  double next_reply_ = 0;
  std::string output_;

  GrblBoardSettings values_;
  GrblBoardParser parser_;
  GrblBoardModes modes_;
  GrblBoardModes pending_;  // modes after the line that is executed
  std::array<std::string, 2> startup_lines_;
  GrblBoardMotion motion_;
  GrblBoardMotion::Limits limits_;
  std::string used_options_;
  std::deque<Task> tasks_;
  std::deque<std::string> done_;

  double now_ = 0;
  double dwell_left_ = 0;
  bool dwells_ = false;
  double stalls_until_ = 0;
  double stall_part_ = -1;
  int kept_in_stall_ = 0;
  double homes_until_ = 0;
  double restores_until_ = 0;
  bool restores_coolant_ = false;
  double boots_until_ = 0;
  bool boots_ = false;
  bool halted_ = false;
  bool answers_at_reset_ = false;  // the line that led out of the travel
  bool asks_report_ = false;
  bool asks_hold_ = false;
  bool asks_start_ = false;
  bool asks_door_ = false;
  bool asks_cancel_ = false;
  std::vector<unsigned char> asked_overrides_;
  bool cancels_jog_ = false;
  bool waits_for_start_ = false;
  std::string closed_limits_;
  bool door_is_open_ = false;
  bool door_after_jog_ = false;
  bool probes_ = false;
  bool probes_for_touch_ = true;
  bool touched_ = false;
  Point probed_;
  bool probe_succeeded_ = false;
  int feed_override_ = 100;
  int rapid_override_ = 100;
  int spindle_override_ = 100;
  int spindle_ = 5;
  double spindle_speed_ = 0;
  bool flood_ = false;
  bool mist_ = false;
  int offset_count_ = 0;    // reports until WCO
  int override_count_ = 0;  // reports until Ov
  unsigned resets_ = 0;
  std::size_t most_waiting_ = 0;
  bool overflowed_ = false;
  std::size_t lost_bytes_ = 0;
};

}  // namespace passo

#include "kit/strict_grbl_lines.hpp"
