// Checks programs of `passo cam` for other controllers: their words and numbers, arcs, and the order in which they
// move, start the spindle and change tools. The lists are copied from the controllers' manuals; no code of
// Passo is used.
#pragma once

#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace passo::test {

struct ControllerRules {
  std::string name;
  std::set<std::string> g;
  std::set<std::string> m;
  std::string letters;
  int decimals = 4;
  bool has_points = false;  // lengths need a point
  bool has_frame = false;   // '%', O, N
  bool dwells_in_ms = false;
  std::size_t longest_line = 0;  // 0: any
  std::string bad_characters = {};
  double most_radius = 1e9;  // mm
  double most_degrees = 360;
  std::string end = "2";
};

inline std::vector<ControllerRules> controller_rules() {
  const std::set<std::string> plain{"0", "1", "2", "3", "4", "17", "18", "19", "20", "21", "40", "80", "90", "94"};
  const auto with = [&](std::initializer_list<const char*> more) {
    std::set<std::string> all = plain;
    for (const char* word : more) all.insert(word);
    return all;
  };
  return {
      // linuxcnc.org, "G-Codes" and "M-Codes"; G64 without P would cut corners without a limit.
      {.name = "linuxcnc",
       .g = with({"43", "64", "81", "83", "91.1", "93", "98", "99"}),
       .m = {"2", "3", "4", "5", "6", "8", "9"},
       .letters = "FGHIJKMPQRSTUVXYZ",
       .longest_line = 255},
      // gnea/grbl, doc/markdown/commands.md and interface.md: no cycles, no M6, no %; a line has at most
      // 80 characters. '!', '?' and '~' and all bytes from 0x80 are commands.
      {.name = "grbl",
       .g = with({"91.1", "93"}),
       .m = {"0", "2", "3", "4", "5", "8", "9"},
       .letters = "FGIJKMPSTXYZ",
       .longest_line = 79,
       .bad_characters = "!?~%",
       .most_radius = 1000},
      // grblHAL/core, README: cycles and M6, which waits for a manual change.
      {.name = "grblhal",
       .g = with({"81", "83", "91.1", "93", "98", "99"}),
       .m = {"2", "3", "4", "5", "6", "8", "9"},
       .letters = "FGIJKMPQRSTUVXYZ",
       .longest_line = 255,
       .bad_characters = "!?~",
       .most_radius = 1000},
      // Using Mach3Mill, chapter 10.
      {.name = "mach3",
       .g = with({"43", "64", "81", "83", "91.1", "93", "98", "99"}),
       .m = {"3", "4", "5", "6", "8", "9", "30"},
       .letters = "FGHIJKMPQRSTXYZ",
       .longest_line = 255,
       .most_radius = 1000,
       .most_degrees = 180,
       .end = "30"},
      // Series 0i-MF, B-64694EN: X10 would be 10 um; G4 P counts milliseconds.
      {.name = "fanuc-like",
       .g = with({"43", "81", "83", "98", "99"}),
       .m = {"3", "4", "5", "6", "8", "9", "30"},
       .letters = "FGHIJKMNOPQRSTXYZ",
       .decimals = 3,
       .has_points = true,
       .has_frame = true,
       .dwells_in_ms = true,
       .longest_line = 80,
       .bad_characters = "abcdefghijklmnopqrstuvwxyz!?~:;'",
       .most_radius = 1000,
       .most_degrees = 180,
       .end = "30"},
  };
}

// What the operation promises.
struct SafetyRules {
  bool has_z = true;  // Z moves the tool
  bool has_spindle = true;
  double lowest_crossing = 0.5;  // Z below which no rapid may move in X or Y, mm
  double change_height = 20;     // mm
  bool may_be_inch = false;
};

// Follows a program line by line, and collects what is wrong.
class ControllerCheck {
 public:
  ControllerCheck(const ControllerRules& rules, const SafetyRules& safety) : rules_(rules), safety_(safety) {}

  std::vector<std::string> check(const std::string& program) {
    std::istringstream lines(program);
    std::string line;
    std::vector<std::string> all;
    while (std::getline(lines, line)) all.push_back(line);
    std::size_t begin = 0;
    std::size_t end = all.size();
    if (rules_.has_frame) {
      if (all.size() < 3 || all.front() != "%" || all.back() != "%") complain("no '%' at the start and the end");
      if (all.size() > 1 && (all[1].empty() || all[1].front() != 'O')) complain("no program number");
      begin = 2;
      if (end > 0) --end;
    }
    for (number_ = begin + 1; number_ <= end; ++number_) check_line(all[number_ - 1]);
    if (!has_ended_) complain("the program does not end");
    return complaints_;
  }

  // How often a tool was called.
  int changes() const { return changes_; }
  int arcs() const { return arcs_; }

 private:
  struct Word {
    char letter;
    std::string digits;
    double value;
  };

  void complain(const std::string& why) {
    if (complaints_.size() < 5) complaints_.push_back(rules_.name + ", line " + std::to_string(number_) + ": " + why);
  }

  void check_line(const std::string& line) {
    if (rules_.longest_line > 0 && line.size() > rules_.longest_line) complain("too long: " + line);
    if (line.find_first_of(rules_.bad_characters) != std::string::npos && !rules_.bad_characters.empty())
      complain("a character that acts or is unknown: " + line);
    if (rules_.name != "linuxcnc") {
      for (const char c : line) {
        if (static_cast<unsigned char>(c) >= 0x80) complain("not ASCII: " + line);
      }
    }
    words_.clear();
    if (!split(line) || words_.empty()) return;
    if (has_ended_) complain("words behind the end");
    if (rules_.has_frame && words_.front().letter != 'N') complain("no line number");
    for (const Word& word : words_) check_word(word);
    check_groups();
    follow();
  }

  bool split(const std::string& line) {
    std::size_t at = 0;
    while (at < line.size()) {
      if (line[at] == ' ') {
        ++at;
      } else if (line[at] == '(') {
        const std::size_t close = line.find(')', at);
        if (close == std::string::npos || line.find('(', at + 1) < close) {
          complain("a broken comment: " + line);
          return false;
        }
        at = close + 1;
      } else {
        const char letter = line[at++];
        const std::size_t end = line.find_first_not_of("0123456789.-", at);
        const std::string digits = line.substr(at, end == std::string::npos ? end : end - at);
        if (letter < 'A' || letter > 'Z' || digits.empty()) {
          complain("no word: " + line);
          return false;
        }
        words_.push_back({letter, digits, std::strtod(digits.c_str(), nullptr)});
        at += digits.size();
      }
    }
    return true;
  }

  void check_word(const Word& word) {
    if (rules_.letters.find(word.letter) == std::string::npos) complain(std::string("unknown letter ") + word.letter);
    if (word.letter == 'G' && !rules_.g.contains(word.digits)) complain("unknown G" + word.digits);
    if (word.letter == 'M' && !rules_.m.contains(word.digits)) complain("unknown M" + word.digits);
    const std::size_t point = word.digits.find('.');
    const bool is_length = std::string("XYZUVIJKRQF").find(word.letter) != std::string::npos;
    if (is_length && rules_.has_points && point == std::string::npos) complain("no point in " + word.digits);
    const std::size_t most = static_cast<std::size_t>(rules_.decimals) + (is_inch_ ? 1U : 0U);
    if (is_length && !is_inverse_ && point != std::string::npos && word.digits.size() - point - 1 > most)
      complain("too many decimals: " + word.digits);
  }

  // At most one G word of a modal group.
  void check_groups() {
    int motions = 0;
    int planes = 0;
    int ms = 0;
    for (const Word& word : words_) {
      if (word.letter == 'M') ++ms;
      if (word.letter != 'G') continue;
      static const std::set<std::string> motion{"0", "1", "2", "3", "81", "83"};
      static const std::set<std::string> plane{"17", "18", "19"};
      motions += motion.contains(word.digits) ? 1 : 0;
      planes += plane.contains(word.digits) ? 1 : 0;
    }
    if (motions > 1 || planes > 1 || ms > 1) complain("two words of one modal group");
  }

  const Word* find(char letter) const {
    for (const Word& word : words_) {
      if (word.letter == letter) return &word;
    }
    return nullptr;
  }
  bool has_g(const char* digits) const {
    for (const Word& word : words_) {
      if (word.letter == 'G' && word.digits == digits) return true;
    }
    return false;
  }

  void follow() {
    for (const Word& word : words_) {
      if (word.letter == 'G') follow_g(word.digits);
    }
    if (find('F') != nullptr) has_feed_ = true;
    if (has_g("4")) {
      const double seconds = find('P') == nullptr ? 0 : find('P')->value / (rules_.dwells_in_ms ? 1000 : 1);
      if (seconds > 60) complain("a dwell of " + std::to_string(seconds) + " s");
      if (seconds >= 1) has_dwelt_ = true;
      return;
    }
    for (const Word& word : words_) {
      if (word.letter == 'M') follow_m(word.digits);
    }
    const bool has_axis = find('X') != nullptr || find('Y') != nullptr || find('Z') != nullptr;
    if (has_axis) move();
  }

  void follow_g(const std::string& digits) {
    if (digits == "0" || digits == "1" || digits == "2" || digits == "3" || digits == "81" || digits == "83")
      motion_ = std::atoi(digits.c_str());
    if (digits == "80") motion_ = -1;
    if (digits == "17" || digits == "18" || digits == "19") plane_ = std::atoi(digits.c_str());
    if (digits == "21") has_units_ = true;
    if (digits == "20") has_units_ = is_inch_ = true;
    if (digits == "90") is_absolute_ = true;
    if (digits == "93" || digits == "94") {
      is_inverse_ = digits == "93";
      has_feed_ = false;
    }
    if (digits == "98" || digits == "99") returns_low_ = digits == "99";
  }

  void follow_m(const std::string& digits) {
    if (digits == "3" && safety_.has_spindle) {
      spindle_ = true;
      has_dwelt_ = false;
      if (find('S') == nullptr) complain("M3 without S");
      if (safety_.has_z && (!knows_z_ || mm(at_[2]) < safety_.lowest_crossing)) complain("M3 below the clearance");
    }
    if (digits == "5") spindle_ = false;
    const bool is_change = digits == "6" || digits == "0";
    if (is_change) {
      ++changes_;
      if (spindle_) complain("a tool change with the spindle on");
      if (!knows_z_ || mm(at_[2]) < safety_.change_height - 0.01) complain("a tool change below the change height");
      must_rise_ = true;
    }
    if (digits == "2" || digits == "30") {
      has_ended_ = true;
      if (digits != rules_.end) complain("ends with M" + digits);
      if (spindle_ && safety_.has_spindle) complain("ends with the spindle on");
      if (!safety_.has_z) return;
      if (mm(at_[2]) < safety_.change_height - 0.01) complain("ends below the change height");
      if (at_[0] != 0 || at_[1] != 0) complain("does not end at the park position");
    }
  }

  double mm(double length) const { return is_inch_ ? length * 25.4 : length; }

  void move() {
    if (!has_units_ || !is_absolute_) complain("a move before the units and G90");
    if (motion_ < 0) {
      complain("axis words without a motion");
      return;
    }
    std::array<double, 3> to = at_;
    for (int i = 0; i < 3; ++i) {
      if (const Word* word = find("XYZ"[i]); word != nullptr) to[static_cast<std::size_t>(i)] = word->value;
    }
    const bool crosses = find('X') != nullptr || find('Y') != nullptr;
    const bool is_cycle = motion_ == 81 || motion_ == 83;
    if (safety_.has_z) check_height(to, crosses, is_cycle);
    if (motion_ != 0 && !has_feed_) complain("a feed move without a feed");
    if (motion_ == 2 || motion_ == 3) check_arc(to);
    if (is_cycle) {
      // The tool is at R or where the cycle began.
      if (const Word* word = find('R'); word != nullptr) retract_ = word->value;
      if (!is_in_cycle_) start_ = at_[2];
      to[2] = returns_low_ ? retract_ : start_;
    } else if (find('Z') != nullptr) {
      knows_z_ = true;
    }
    is_in_cycle_ = is_cycle;
    at_ = to;
  }

  void check_height(const std::array<double, 3>& to, bool crosses, bool is_cycle) {
    if (!has_moved_ || must_rise_) {
      if (motion_ != 0 || crosses || find('Z') == nullptr || mm(to[2]) < safety_.change_height - 0.01)
        complain("the first move is not up to the change height");
      has_moved_ = true;
      must_rise_ = false;
      return;
    }
    const bool is_low_rapid = crosses && (motion_ == 0 || is_cycle) && mm(at_[2]) < safety_.lowest_crossing - 1e-4;
    if (is_low_rapid) complain("a rapid across at Z" + std::to_string(at_[2]));
    if (motion_ == 0 && crosses && find('Z') != nullptr && to[2] < at_[2]) complain("a rapid across and down");
    const bool cuts = motion_ != 0 && mm(to[2]) < 0;
    if (cuts && safety_.has_spindle && (!spindle_ || !has_dwelt_)) complain("a cut before the spindle has its speed");
  }

  void check_arc(const std::array<double, 3>& to) {
    ++arcs_;
    const std::size_t a = plane_ == 17 ? 0 : plane_ == 18 ? 2 : 1;
    const std::size_t b = plane_ == 17 ? 1 : plane_ == 18 ? 0 : 2;
    const auto offset = [&](std::size_t axis) {
      const Word* const word = find("IJK"[axis]);
      return word == nullptr ? 0.0 : word->value;
    };
    const double ca = at_[a] + offset(a);
    const double cb = at_[b] + offset(b);
    const double from = std::hypot(at_[a] - ca, at_[b] - cb);
    const double end = std::hypot(to[a] - ca, to[b] - cb);
    const double off = mm(std::abs(from - end));
    // The rule of LinuxCNC and Grbl.
    if (off > 0.5 || (off > 0.005 && off > 0.001 * mm(from))) complain("the ends of an arc differ in radius");
    if (mm(from) > rules_.most_radius + 0.01 || mm(from) < 0.009) complain("an arc of radius " + std::to_string(from));
    const double turn = 2 * std::numbers::pi;
    double sweep = std::atan2(to[b] - cb, to[a] - ca) - std::atan2(at_[b] - cb, at_[a] - ca);
    if (motion_ == 2) sweep = -sweep;
    while (sweep <= 1e-9) sweep += turn;
    if (sweep * 360 / turn > rules_.most_degrees + 1) complain("an arc of too many degrees");
  }

  const ControllerRules& rules_;
  const SafetyRules& safety_;
  std::vector<std::string> complaints_;
  std::vector<Word> words_;
  std::array<double, 3> at_{};
  std::size_t number_ = 0;
  int motion_ = -1;
  int plane_ = 17;
  int changes_ = 0;
  int arcs_ = 0;
  double retract_ = 0;
  double start_ = 0;
  bool is_in_cycle_ = false;
  bool returns_low_ = false;
  bool has_units_ = false;
  bool is_inch_ = false;
  bool is_absolute_ = false;
  bool is_inverse_ = false;
  bool has_feed_ = false;
  bool has_moved_ = false;
  bool must_rise_ = false;
  bool knows_z_ = false;
  bool spindle_ = false;
  bool has_dwelt_ = false;
  bool has_ended_ = false;
};

}  // namespace passo::test
