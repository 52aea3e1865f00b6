// StrictGrbl: a Grbl 1.1 machine modelled on grbl's sources, in virtual time, with a receive buffer that loses bytes on
// overflow. It accepts the lines that GrblCode writes, and refuses all others.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <deque>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace passo {

class StrictGrbl {
 public:
  explicit StrictGrbl(std::size_t bytes = 128) : bytes_(bytes) {}

  std::string greeting = "Grbl 1.1h ['$' for help]";
  std::string options = "V,15,128";
  std::string more_of_itself = {};  // whole lines sent after the options
  std::string settings = "$10=1\r\n$13=0\r\n$22=0\r\n";
  std::string offsets = "[G54:0.000,0.000,0.000]\r\n[G92:0.000,0.000,0.000]\r\n[TLO:0.000]\r\n";
  std::string modes = "G0 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0";
  std::function<std::string()> own_report = {};  // generates reports in another format
  double spindle_time = 0;                       // duration of M3, s
  bool has_switches = true;                      // whether there are limit switches for $H
  bool homes_for_ever = false;
  double block_time = 0.05;  // duration of each motion, s
  std::string refused = {};  // a line that gets error:20
  std::string trips = {};    // a line at which a limit switch closes
  bool loses_next_line_end = false;

  std::size_t most_waiting() const { return most_waiting_; }
  bool overflowed() const { return overflowed_; }
  const std::deque<std::string>& done() const { return done_; }
  std::string take_output() { return std::exchange(output_, {}); }
  std::string state = "Idle";
  double x = 0;
  bool silent = false;

  void restart() {
    waiting_.clear();
    planner_.clear();
    output_ += "\r\n" + greeting + "\r\n";
  }
  void say(const std::string& line) { output_ += line + "\r\n"; }
  void resume() { begin_motion(); }

  void receive(std::string_view bytes) {
    for (const char byte : bytes) {
      if (take_real_time(byte)) continue;
      if (byte == '\n' && std::exchange(loses_next_line_end, false)) continue;
      if (waiting_.size() >= bytes_) {
        overflowed_ = true;
        continue;
      }
      waiting_ += byte;
      most_waiting_ = std::max(most_waiting_, waiting_.size());
    }
  }

  // Advances the time.
  void run(double seconds) {
    read_lines();
    now_ += seconds;
    while (state == "Run" && !planner_.empty() && now_ >= end_) {
      finish_block();
      read_lines();
    }
    if (state == "Run" && planner_.empty()) state = "Idle";
    if (dwell_until_ > 0 && now_ >= dwell_until_) {
      dwell_until_ = 0;
      output_ += "ok\r\n";
    }
    read_lines();
  }

 private:
  bool take_real_time(char byte) {
    switch (static_cast<unsigned char>(byte)) {
      case '?':
        if (!silent) report();
        return true;
      case '!':
        if (state != "Alarm") state = "Hold:0";
        return true;
      case '~':
        if (state == "Hold:0") begin_motion();
        return true;
      case 0x18:
        if (state == "Run") output_ += "ALARM:3\r\n";
        state = state == "Run" || state == "Alarm" ? "Alarm" : "Idle";
        dwell_until_ = 0;
        restart();
        return true;
      default: return (static_cast<unsigned char>(byte) & 0x80U) != 0;
    }
  }
  void report() {
    if (own_report) return say(own_report());
    output_ += fmt::format("<{}|MPos:{:.3f},0.000,0.000|Bf:{},{}|FS:0,0|WCO:0.000,0.000,0.000>\r\n", state, x,
                           15 - planner_.size(), bytes_ - waiting_.size());
  }
  void begin_motion() {
    state = planner_.empty() ? "Idle" : "Run";
    end_ = now_ + block_time;
  }
  void finish_block() {
    const std::string line = planner_.front();
    planner_.pop_front();
    done_.push_back(line);
    const std::size_t at = line.find('X');
    if (at != std::string::npos) x = std::atof(line.c_str() + at + 1);
    end_ += block_time;
    if (line != trips) return;
    state = "Alarm";
    output_ += "ALARM:1\r\n";
  }
  void read_lines() {
    while (dwell_until_ == 0 && takes_lines() && planner_.size() < 15) {
      const std::size_t end = waiting_.find('\n');
      if (end == std::string::npos) return;
      const std::string line = waiting_.substr(0, end);
      const bool waits = line.starts_with("G4") || line.starts_with('M');
      if (waits && !planner_.empty()) return;  // a line without motion waits until all motion is complete
      waiting_.erase(0, end + 1);
      take(line);
    }
  }
  bool takes_lines() const { return state == "Idle" || state == "Run" || state == "Hold:0" || state == "Alarm"; }
  void take(const std::string& line) {
    if (line.size() > 79) {
      output_ += "error:11\r\n";
    } else if (line == "$I") {
      output_ += "[VER:1.1h.20190830:]\r\n[OPT:" + options + "]\r\n" + more_of_itself + "ok\r\n";
    } else if (line == "$$") {
      output_ += settings + "ok\r\n";
    } else if (line == "$#") {
      output_ += offsets + "ok\r\n";
    } else if (line == "$H" && homes_for_ever) {
      state = "Home";
    } else if (line == "$H") {
      state = has_switches ? "Idle" : "Alarm";
      output_ += has_switches ? "ok\r\n" : "ALARM:9\r\n";
    } else if (line == "$G") {
      output_ += "[GC:" + modes + "]\r\nok\r\n";
    } else if (state == "Alarm") {
      output_ += line.empty() ? "ok\r\n" : "error:9\r\n";
    } else if (line == refused || line.find_first_not_of("GXYZFIJKMSP0123456789.-") != std::string::npos) {
      output_ += "error:20\r\n";
    } else if (line.starts_with("G4P")) {
      dwell_until_ = now_ + std::atof(line.c_str() + 3) + 1e-9;
      done_.push_back(line);
    } else if (line.starts_with("M3") && spindle_time > 0) {
      dwell_until_ = now_ + spindle_time;
    } else {
      output_ += "ok\r\n";
      if (line.empty() || line.front() == 'M' || line.starts_with("G2")) return;
      planner_.push_back(line);
      if (state == "Idle") begin_motion();
    }
  }

  std::size_t bytes_;
  std::string waiting_;
  std::deque<std::string> planner_;
  std::deque<std::string> done_;
  std::string output_;
  double now_ = 0;
  double end_ = 0;
  double dwell_until_ = 0;
  std::size_t most_waiting_ = 0;
  bool overflowed_ = false;
};

}  // namespace passo
