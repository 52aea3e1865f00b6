// FirmwareFake: a board with one of the firmwares that speak Grbl's protocol, in virtual time, written after their
// published sources (gnea/grbl, gnea/grbl-Mega, fra589/grbl-Mega-5X, grblHAL/core, bdring/FluidNC, Paciente8159/uCNC).
//
// It differs from StrictGrbl in what distinguishes the firmwares: what the board says of itself, how many axes it has,
// how it stores settings, and how it measures the way to which F applies. A move takes the time that F gives, without
// acceleration, so tests can compare times exactly. Arcs are in the XY plane.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <deque>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace passo::test {

struct FirmwareTraits {
  std::string greeting;
  std::vector<std::string> about;            // the answer to $I
  std::vector<std::string> more_about = {};  // the answer to $I+; empty: error:3
  std::string axes = "XYZ";                  // in the order of the reports
  std::string linear = {};                   // axes to whose way F applies if they move; empty: all
  std::size_t blocks = 15;
  std::size_t bytes = 128;
  std::vector<std::pair<std::string, std::string>> settings = {};  // names without '$'
  std::map<std::string, std::vector<std::string>> answers = {};    // other questions, e.g. "$ES"
  // Returns the error of a new value, or changes it as the firmware does; 0: it is stored.
  std::function<int(const std::string& name, std::string& value)> store = {};
  bool shows_buffer = true;
  bool tells_modes = false;          // [GC:…] after a report, if they have changed
  double report_interval = 0;        // s; above 0: reports unasked
  bool echoes = false;               // [echo: …] before each answer
  std::string more_of_reports = {};  // further fields: "|Pn:X|WCO:…"
  std::string line_end = "\r\n";
  bool is_core_xy = false;  // F applies to the motors x + y and x - y
};

class FirmwareFake {
 public:
  struct Move {
    std::map<char, double> end;
    double duration = 0;  // s; 0 for G0
  };

  explicit FirmwareFake(FirmwareTraits traits) : traits_(std::move(traits)) {
    for (const char letter : traits_.axes) place_[letter] = target_[letter] = 0;
  }

  FirmwareTraits& traits() { return traits_; }
  const std::vector<Move>& moves() const { return moves_; }
  const std::vector<std::string>& lines() const { return lines_; }  // all lines that it has taken
  std::string take_output() { return std::exchange(output_, {}); }
  bool overflowed() const { return overflowed_; }
  std::string setting(const std::string& name) const {
    const auto found = find(name);
    return found == traits_.settings.end() ? "" : found->second;
  }
  void restart() {
    waiting_.clear();
    queue_.clear();
    output_ += "\r\n" + traits_.greeting + "\r\n";
  }

  void receive(std::string_view bytes) {
    for (const char byte : bytes) {
      const auto code = static_cast<unsigned char>(byte);
      if (byte == '?') {
        report();
      } else if (code == 0x18) {
        restart();
      } else if (byte == '!' || byte == '~' || code >= 0x80) {
        continue;
      } else if (waiting_.size() >= traits_.bytes) {
        overflowed_ = true;
      } else {
        waiting_ += byte;
      }
    }
  }

  void run(double seconds) {
    read_lines();
    now_ += seconds;
    if (traits_.report_interval > 0 && now_ >= next_report_) {
      next_report_ = now_ + traits_.report_interval;
      report();
    }
    while (!queue_.empty() && queue_.front().end <= now_) {
      place_ = queue_.front().to;
      queue_.pop_front();
      read_lines();
    }
    if (!queue_.empty()) {
      const Block& block = queue_.front();
      const double share = std::max(0.0, (now_ - block.begun) / (block.end - block.begun));
      for (auto& [letter, value] : place_) {
        value = block.from.at(letter) + share * (block.to.at(letter) - block.from.at(letter));
      }
    }
    read_lines();
  }

 private:
  using Setting = std::pair<std::string, std::string>;
  struct Block {
    double begun = 0;
    double end = 0;
    std::map<char, double> from;
    std::map<char, double> to;
  };

  std::vector<Setting>::const_iterator find(const std::string& name) const {
    return std::ranges::find(traits_.settings, name, &Setting::first);
  }
  void say(const std::string& line) { output_ += line + traits_.line_end; }
  std::string modes() const {
    return fmt::format("[GC:G{} G54 G17 G21 G90 G{} M5 M9 T0 F{} S0]", motion_, by_time_ ? 93 : 94, feed_);
  }
  void report() {
    std::string values;
    for (const char letter : traits_.axes) values += fmt::format("{}{:.3f}", values.empty() ? "" : ",", place_[letter]);
    const std::string buffer =
        traits_.shows_buffer ? fmt::format("|Bf:{},{}", traits_.blocks - queue_.size(), traits_.bytes - waiting_.size())
                             : "";
    say(fmt::format("<{}|MPos:{}{}|FS:0,0{}>", queue_.empty() ? "Idle" : "Run", values, buffer,
                    traits_.more_of_reports));
    if (traits_.tells_modes && modes() != told_modes_) say(told_modes_ = modes());
  }
  void read_lines() {
    for (std::size_t end = 0; (end = waiting_.find('\n')) != std::string::npos;) {
      const std::string line = waiting_.substr(0, end);
      const bool moves = !line.empty() && line.front() != '$' && line.front() != 'M' && !line.starts_with("G4P");
      if (queue_.size() >= traits_.blocks || (!moves && !queue_.empty())) return;
      waiting_.erase(0, end + 1);
      if (!line.empty()) lines_.push_back(line);
      if (traits_.echoes) say("[echo: " + line + "]");
      take(line);
    }
  }
  void answer(const std::vector<std::string>& told) {
    for (const std::string& line : told) say(line);
    say("ok");
  }
  void take(const std::string& line) {
    if (line == "$I") return answer(traits_.about);
    if (line == "$I+" && !traits_.more_about.empty()) return answer(traits_.more_about);
    if (line == "$#") return tell_offsets();
    if (line == "$G") return answer({modes()});
    if (line == "$$") {
      for (const auto& [name, value] : traits_.settings) say(fmt::format("${}={}", name, value));
      return say("ok");
    }
    if (const auto found = traits_.answers.find(line); found != traits_.answers.end()) return answer(found->second);
    if (line.starts_with('$')) return store(line);
    say(line.empty() || line.front() == 'M' || line.starts_with("G4P") ? "ok" : move(line));
  }
  void tell_offsets() {
    const std::string zeros = [this] {
      std::string text = "0.000";
      for (std::size_t i = 1; i < traits_.axes.size(); ++i) text += ",0.000";
      return text;
    }();
    answer({"[G54:" + zeros + "]", "[G92:" + zeros + "]", "[TLO:0.000]", "[PRB:" + zeros + ":0]"});
  }
  void store(const std::string& line) {
    const std::size_t equals = line.find('=');
    const std::string name = equals == std::string::npos ? "" : line.substr(1, equals - 1);
    const auto found = std::ranges::find(traits_.settings, name, &Setting::first);
    if (found == traits_.settings.end()) return say("error:3");
    std::string value = line.substr(equals + 1);
    const int error = traits_.store ? traits_.store(name, value) : 0;
    if (error != 0) return say(fmt::format("error:{}", error));
    found->second = value;
    say("ok");
  }

  // Returns the answer.
  std::string move(const std::string& line) {
    std::map<char, double> end = target_;
    std::map<char, double> words;
    double feed = -1;
    for (std::size_t i = 0; i < line.size();) {
      const char letter = line[i++];
      std::size_t size = 0;
      while (i + size < line.size() && std::string_view("0123456789.-").find(line[i + size]) != std::string_view::npos)
        ++size;
      if (size == 0) return "error:2";
      const double value = std::atof(line.substr(i, size).c_str());
      i += size;
      if (letter == 'G' && value <= 3) {
        motion_ = static_cast<int>(value);
      } else if (letter == 'G' && (value == 93 || value == 94)) {
        by_time_ = value == 93;
        feed_ = 0;
      } else if (letter == 'F') {
        feed = value;
      } else if (traits_.axes.find(letter) != std::string::npos) {
        if (words.contains(letter)) return "error:25";
        end[letter] = words[letter] = value;
      } else if (letter == 'I' || letter == 'J' || letter == 'K') {
        words[letter] = value;
      } else if (letter != 'G') {
        return "error:20";
      }
    }
    if (feed >= 0) feed_ = feed;
    if (by_time_ && motion_ != 0 && feed < 0) return "error:22";
    if (motion_ != 0 && feed_ <= 0) return "error:22";
    double duration = 0;
    if (motion_ != 0) duration = by_time_ ? 60 / feed_ : way(end, words) / (feed_ / 60);
    moves_.push_back({.end = end, .duration = duration});
    const double begun = queue_.empty() ? now_ : queue_.back().end;
    queue_.push_back({.begun = begun, .end = begun + (duration > 0 ? duration : 0.01), .from = target_, .to = end});
    target_ = end;
    return "ok";
  }
  // The way to which F applies.
  double way(const std::map<char, double>& end, const std::map<char, double>& words) const {
    double all = 0;
    double linear = 0;
    for (const auto& [letter, value] : end) {
      const double part = value - target_.at(letter);
      all += part * part * (traits_.is_core_xy && (letter == 'X' || letter == 'Y') ? 2 : 1);
      if (traits_.linear.find(letter) != std::string::npos) linear += part * part;
    }
    if (motion_ >= 2) {
      const double i = words.contains('I') ? words.at('I') : 0;
      const double j = words.contains('J') ? words.at('J') : 0;
      const double from = std::atan2(-j, -i);
      const double to = std::atan2(end.at('Y') - target_.at('Y') - j, end.at('X') - target_.at('X') - i);
      double turn = motion_ == 3 ? to - from : from - to;
      if (turn <= 1e-9) turn += 2 * std::numbers::pi;
      const double factor = traits_.is_core_xy ? std::numbers::sqrt2 : 1;
      return std::hypot(factor * turn * std::hypot(i, j), end.at('Z') - target_.at('Z'));
    }
    return std::sqrt(linear > 0 ? linear : all);
  }

  FirmwareTraits traits_;
  std::string waiting_;
  std::string output_;
  std::vector<std::string> lines_;
  std::vector<Move> moves_;
  std::deque<Block> queue_;
  std::map<char, double> place_;
  std::map<char, double> target_;
  std::string told_modes_;
  double now_ = 0;
  double next_report_ = 0;
  double feed_ = 0;
  int motion_ = 0;
  bool by_time_ = false;
  bool overflowed_ = false;
};

// The settings of Grbl 1.1 for these axes, with Grbl's own defaults.
inline std::vector<std::pair<std::string, std::string>> settings_of_grbl(std::size_t axes) {
  std::vector<std::pair<std::string, std::string>> all = {
      {"0", "10"},     {"1", "25"},    {"2", "0"},      {"3", "0"},       {"4", "0"},        {"5", "0"},
      {"6", "0"},      {"10", "1"},    {"11", "0.010"}, {"12", "0.002"},  {"13", "0"},       {"20", "0"},
      {"21", "0"},     {"22", "0"},    {"23", "0"},     {"24", "25.000"}, {"25", "500.000"}, {"26", "250"},
      {"27", "1.000"}, {"30", "1000"}, {"31", "0"},     {"32", "0"}};
  for (const auto& [first, value] : std::array<std::pair<int, const char*>, 4>{
           {{100, "250.000"}, {110, "500.000"}, {120, "10.000"}, {130, "200.000"}}}) {
    for (std::size_t i = 0; i < axes; ++i) all.emplace_back(fmt::format("{}", first + static_cast<int>(i)), value);
  }
  return all;
}

// As settings_store_global_setting() of Grbl 1.1 does.
inline int store_as_grbl(const std::string& name, std::string& value) {
  const double number = std::atof(value.c_str());
  if (value.empty() || value.find_first_not_of("0123456789.-") != std::string::npos) return 2;
  if (number < 0) return 4;
  const int id = std::atoi(name.c_str());
  if (id == 0 && number < 3) return 6;
  constexpr std::array floats = {11, 12, 24, 25, 27};
  const bool is_float = id >= 100 || std::ranges::find(floats, id) != floats.end();
  value = is_float ? fmt::format("{:.3f}", number) : fmt::format("{}", static_cast<int>(number) & 255);
  if (id == 26 || id == 30 || id == 31) value = fmt::format("{}", static_cast<int>(number));
  return 0;
}

inline FirmwareTraits grbl_mega() {
  return {.greeting = "Grbl 1.1h ['$' for help]",
          .about = {"[VER:1.1h.20190825:]", "[OPT:V,35,255]"},
          .blocks = 35,
          .bytes = 255,
          .settings = settings_of_grbl(3),
          .store = store_as_grbl};
}

inline FirmwareTraits grbl_mega_5x(const std::string& axes = "XYZAB") {
  return {.greeting = "Grbl 1.2i ['$' for help]",
          .about = {"[VER:1.2i.20260521:]", fmt::format("[AXS:{}:{}]", axes.size(), axes), "[OPT:VNMGH,35,255,0]"},
          .axes = axes,
          .blocks = 35,
          .bytes = 255,
          .settings = settings_of_grbl(axes.size()),
          .store = store_as_grbl};
}

// `rotary_fix`: it was built with ROTARY_FIX, so that F applies to the linear axes alone.
inline FirmwareTraits grblhal(const std::string& axes = "XYZ", bool rotary_fix = false) {
  const std::vector<std::string> about = {"[VER:1.1f.20260817:]", "[OPT:VNML+,100,1024]"};
  const std::vector<std::string> more = {"[VER:1.1f.20260817:]", fmt::format("[OPT:VNML+,100,1024,{},0]", axes.size()),
                                         fmt::format("[AXS:{}:{}]", axes.size(), axes), "[NEWOPT:ENUMS,RT+,TC,SED]",
                                         "[FIRMWARE:grblHAL]"};
  FirmwareTraits traits{.greeting = "GrblHAL 1.1f ['$' or '$HELP' for help]",
                        .about = about,
                        .more_about = more,
                        .axes = axes,
                        .blocks = 100,
                        .bytes = 1023,
                        .settings = settings_of_grbl(axes.size())};
  if (rotary_fix) {
    for (const char letter : axes) {
      if (letter < 'A' || letter > 'C') traits.linear += letter;
    }
  }
  traits.settings.emplace_back("341", "0");
  traits.settings.emplace_back("398", "100");
  traits.settings.emplace_back("74", "********");
  traits.answers["$EA"] = {"[ALARMCODE:1||Hard limit has been triggered.]", "[ALARMCODE:99||The coolant is empty.]"};
  traits.answers["$EG"] = {"[SETTINGGROUP:0|0|Root]", "[SETTINGGROUP:1|0|General]", "[SETTINGGROUP:9|0|Tool change]"};
  traits.answers["$ES"] = {
      "[SETTING:0|1|Step pulse time|microseconds|6|#0.0|2.0||0|0]",
      "[SETTING:10|1|Status report options||1|Position in machine coordinate,N/A,Line numbers|||0|0]",
      "[SETTING:23|1|Homing direction invert||4||||0|0]",
      "[SETTING:74|1|Password||8|x(32)||32|1|1]",
      "[SETTING:341|9|Tool change mode||3|Normal,Manual touch off,Ignore M6|||0|0]",
      "[SETTING:398|1|Planner buffer blocks||5|####0|30|1000|1|0]"};
  traits.answers["$ESH"] = {
      "$-Code\tSetting\tUnits\tDatatype\tData format\tSetting Description\tMin\tMax",
      "398\tPlanner buffer blocks\t\tinteger\t####0\tNumber of blocks.\\n\\nNOTE: Restart the board.\t30\t1000\t1\t0"};
  traits.store = [](const std::string& name, std::string& value) {
    const double number = std::atof(value.c_str());
    if (name == "0" && number < 2) return 52;
    if (name == "398" && (number < 30 || number > 1000)) return 52;
    if (name == "74") {
      value = "********";
      return 0;
    }
    return store_as_grbl(name == "0" ? "11" : name, value);
  };
  return traits;
}

inline FirmwareTraits fluidnc(std::size_t axes = 3) {
  FirmwareTraits traits{.greeting = "Grbl 4.0 [FluidNC v4.0.1 (wifi) '$' for help]",
                        .about = {"[VER:4.0 FluidNC v4.0.1:]", "[OPT:MPHS]", "[MSG: Machine: Foam]"},
                        .axes = std::string("XYZABC").substr(0, axes),
                        .settings = {{"10", "1"},
                                     {"3", "0"},
                                     {"20", "0"},
                                     {"21", "0"},
                                     {"22", "1"},
                                     {"23", "0"},
                                     {"32", "0"},
                                     {"100", "80.000"},
                                     {"101", "80.000"},
                                     {"102", "400.000"},
                                     {"110", "5000.000"}}};
  traits.store = [](const std::string& name, std::string& value) {
    if (name != "10") return 162;
    return value == "0" || value == "1" || value == "2" || value == "3" ? 0 : 80;
  };
  traits.answers["$CD"] = {"name: Foam",
                           "axes:",
                           "  x:",
                           "    steps_per_mm: 80.000",
                           "    max_rate_mm_per_min: 5000.000",
                           "    acceleration_mm_per_sec2: 100.000",
                           "    max_travel_mm: 300.000"};
  return traits;
}

inline FirmwareTraits ucnc(std::size_t axes = 3) {
  const std::vector<std::string> about = {"[VER: uCNC 1.11.0 - Generic board]",
                                          fmt::format("[OPT:C{},DSS3_1000,S0,T1,F,20,128]", axes)};
  FirmwareTraits traits{.greeting = "uCNC 1.11.0 ['$' for help]",
                        .about = about,
                        .more_about = about,
                        .axes = std::string("XYZABC").substr(0, axes),
                        .blocks = 20,
                        .bytes = 128,
                        .settings = settings_of_grbl(axes),
                        .store = store_as_grbl,
                        .shows_buffer = false};
  traits.answers["$SS"] = {};
  return traits;
}

}  // namespace passo::test
