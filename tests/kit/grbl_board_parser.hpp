// GrblBoardParser: G-code as Grbl 1.1 reads it: one line into one block, or the number of Grbl's error. The errors
// come in Grbl's order, so that a line with several faults has the same answer.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "passo/geometry/axes.hpp"

namespace passo {

// The modes of the parser. Motion: 0 to 3, 80, and 382 to 385 for G38.2 to G38.5.
struct GrblBoardModes {
  int motion = 0;
  int system = 54;
  int plane = 17;
  int units = 21;
  int distance = 90;
  int feed_mode = 94;
  int spindle = 5;
  bool flood = false;
  bool mist = false;
  int tool = 0;
  double feed = 0;  // mm/min
  double speed = 0;
  Point position;  // end of the last move, machine coordinates, mm
  Point g92;
  double tool_length = 0;
  std::array<Point, 6> systems{};  // G54 to G59; kept in the EEPROM
  Point g28;
  Point g30;

  Point zero() const {
    Point all = systems[static_cast<std::size_t>(system - 54)] + g92;
    all[Axis::z] += tool_length;
    return all;
  }
};

struct GrblBoardBlock {
  GrblBoardModes after;     // modes after the block
  std::optional<int> move;  // 0, 1, 2, 3 or 382 to 385: moves to `end`
  Point end;
  Point center;          // of an arc, relative to its start
  Axis first = Axis::x;  // plane of an arc
  Axis second = Axis::y;
  double feed = 0;  // mm/min; G93: moves per minute
  bool inverse_time = false;
  std::optional<Point> home;  // G28 and G30: moves there by rapid, after the move to `end` if there is one
  std::optional<double> dwell;
  bool changes_outputs = false;
  bool changes_zero = false;
  std::size_t stored_bytes = 0;  // of the EEPROM
  int flow = -1;                 // M0, M2, M30
  std::uint32_t number = 0;
};

class GrblBoardParser {
 public:
  std::string axes = "XYZ";
  bool has_mist = false;

  // Returns the number of the error; 0: `block` is set. `jog`: the line is the part of $J= after the sign.
  int parse(std::string_view line, bool jog, const GrblBoardModes& now, GrblBoardBlock& block) {
    block = GrblBoardBlock();
    block.after = now;
    words_.fill({});
    groups_ = 0;
    axis_command_ = Command::none;
    other_ = 0;
    flow_ = -1;
    sets_length_ = false;
    length_ = 0;
    if (jog) {
      block.after.motion = 1;
      block.after.feed_mode = 94;
    }
    if (const int error = read_words(line, block.after)) return error;
    const int error = check(jog, now, block);
    return error != 0 ? error : finish(jog, now, block);
  }

 private:
  enum class Command : std::uint8_t { none, other, motion, length };

  static std::size_t slot(char letter) { return static_cast<std::size_t>(letter - 'A'); }
  const std::optional<double>& word(char letter) const { return words_[slot(letter)]; }
  bool is_axis(char letter) const { return axes.find(letter) != std::string::npos; }
  bool has_axes() const {
    for (const char letter : axes) {
      if (word(letter)) return true;
    }
    return false;
  }
  bool group(int number) const { return (groups_ >> static_cast<unsigned>(number) & 1U) != 0; }

  static std::optional<double> read_number(std::string_view line, std::size_t& at) {
    std::string text;
    bool digits = false;
    bool point = false;
    if (at < line.size() && (line[at] == '-' || line[at] == '+')) text += line[at++];
    for (; at < line.size(); ++at) {
      const char c = line[at];
      if (c == '.' && !point) {
        point = true;
      } else if (c >= '0' && c <= '9') {
        digits = true;
      } else {
        break;
      }
      text += c;
    }
    if (!digits) return {};
    return std::strtod(text.c_str(), nullptr);
  }

  int read_words(std::string_view line, GrblBoardModes& modes) {
    for (std::size_t at = 0; at < line.size();) {
      const char letter = line[at++];
      if (letter < 'A' || letter > 'Z') return 1;
      const auto value = read_number(line, at);
      if (!value) return 2;
      int error = 0;
      if (letter == 'G') {
        error = read_g(*value, modes);
      } else if (letter == 'M') {
        error = read_m(*value, modes);
      } else {
        error = read_value(letter, *value);
      }
      if (error != 0) return error;
    }
    return 0;
  }
  int enter(int number) {
    if (group(number)) return 21;
    groups_ |= 1U << static_cast<unsigned>(number);
    return 0;
  }
  int read_g(double value, GrblBoardModes& modes) {
    const int code = static_cast<int>(std::trunc(value));
    int part = static_cast<int>(std::lround(100 * (value - code)));
    int number = 0;
    switch (code) {
      case 10:
      case 28:
      case 30:
      case 92:
        if (part == 0) {
          if (axis_command_ != Command::none) return 24;
          axis_command_ = Command::other;
        }
        [[fallthrough]];
      case 4:
      case 53:
        number = 0;
        other_ = code * 10;
        if (code == 28 || code == 30 || code == 92) {
          if (part != 0 && part != 10) return 20;
          other_ += part / 10;
          part = 0;
        }
        break;
      case 0:
      case 1:
      case 2:
      case 3:
      case 38:
        if (axis_command_ != Command::none) return 24;
        axis_command_ = Command::motion;
        [[fallthrough]];
      case 80:
        number = 1;
        modes.motion = code;
        if (code == 38) {
          if (part != 20 && part != 30 && part != 40 && part != 50) return 20;
          modes.motion = 380 + part / 10;
          part = 0;
        }
        break;
      case 17:
      case 18:
      case 19:
        number = 2;
        modes.plane = code;
        break;
      case 90:
      case 91:
        number = part == 0 ? 3 : 4;
        if (part == 0) modes.distance = code;
        if (part != 0 && (part != 10 || code == 90)) return 20;
        part = 0;
        break;
      case 93:
      case 94:
        number = 5;
        modes.feed_mode = code;
        break;
      case 20:
      case 21:
        number = 6;
        modes.units = code;
        break;
      case 40: number = 7; break;
      case 43:
      case 49:
        number = 8;
        if (axis_command_ != Command::none) return 24;
        axis_command_ = Command::length;
        if (code == 43 && part != 10) return 20;
        sets_length_ = code == 43;
        part = 0;
        break;
      case 54:
      case 55:
      case 56:
      case 57:
      case 58:
      case 59:
        number = 12;
        modes.system = code;
        break;
      case 61:
        number = 13;
        if (part != 0) return 20;
        break;
      default: return 20;
    }
    if (part > 0) return 23;
    return enter(number);
  }
  int read_m(double value, GrblBoardModes& modes) {
    const int code = static_cast<int>(std::trunc(value));
    if (std::lround(100 * (value - code)) > 0) return 23;
    switch (code) {
      case 0:
      case 2:
      case 30: flow_ = code; return enter(20);
      case 1: return enter(20);
      case 3:
      case 4:
      case 5: modes.spindle = code; return enter(21);
      case 7:
        if (!has_mist) return 20;
        modes.mist = true;
        return enter(22);
      case 8: modes.flood = true; return enter(22);
      case 9: modes.flood = modes.mist = false; return enter(22);
      default: return 20;
    }
  }
  int read_value(char letter, double value) {
    const bool known = is_axis(letter) || std::string_view("FIJKLNPRST").find(letter) != std::string_view::npos;
    if (!known) return 20;
    if (letter == 'T' && value > 255) return 38;
    if (word(letter)) return 25;
    if (value < 0 && std::string_view("FNPTS").find(letter) != std::string_view::npos) return 4;
    words_[slot(letter)] = value;
    return 0;
  }

  int check(bool jog, const GrblBoardModes& now, GrblBoardBlock& block) {
    GrblBoardModes& after = block.after;
    const double unit = after.units == 20 ? 25.4 : 1;
    if (has_axes() && axis_command_ == Command::none) axis_command_ = Command::motion;
    if (word('N') && *word('N') > 10'000'000) return 27;
    block.number = static_cast<std::uint32_t>(word('N').value_or(0));
    const bool moves = axis_command_ == Command::motion && after.motion != 80 && after.motion != 0;
    if (jog) {
      if (!word('F')) return 22;
      block.feed = *word('F') * unit;
    } else if (after.feed_mode == 93) {
      if (moves && !word('F')) return 22;
      block.feed = word('F').value_or(0);
    } else if (now.feed_mode == 94) {
      block.feed = word('F') ? *word('F') * unit : now.feed;
    } else {
      block.feed = word('F').value_or(0);
    }
    if (word('S')) after.speed = *word('S');
    if (other_ == 40) {
      if (!word('P')) return 28;
      block.dwell = take('P');
    }
    if (axis_command_ == Command::length && sets_length_) {
      for (const char letter : axes) {
        if (word(letter).has_value() != (letter == 'Z')) return 37;
      }
      length_ = *word('Z') * unit;
    }
    if (after.system > 59) return 29;
    if (const int error = check_other(now, block, unit)) return error;
    if (after.motion == 80) {
      if (has_axes()) return 31;
    } else if (axis_command_ == Command::motion) {
      if (const int error = check_motion(now, block, unit)) return error;
    }
    return check_unused(jog);
  }
  double take(char letter) {
    const double value = *word(letter);
    words_[slot(letter)] = {};
    return value;
  }
  int check_unused(bool jog) {
    for (const char letter : std::string_view(jog ? "NF" : "NFS")) words_[slot(letter)] = {};
    if (axis_command_ != Command::none) {
      for (const char letter : axes) words_[slot(letter)] = {};
    }
    for (std::size_t i = 0; i < words_.size(); ++i) {
      if (words_[i] && (jog || i != slot('T'))) return 36;
    }
    return 0;
  }
  int check_other(const GrblBoardModes& now, GrblBoardBlock& block, double unit) {
    GrblBoardModes& after = block.after;
    if (other_ == 100) return check_g10(now, block, unit);
    if (other_ == 920) {
      if (!has_axes()) return 26;
      each_axis([&](Axis axis, double value) {
        const double system = after.systems[static_cast<std::size_t>(after.system - 54)][axis];
        after.g92[axis] = now.position[axis] - system - value * unit;
        if (axis == Axis::z) after.g92[axis] -= now.tool_length;
      });
      block.changes_zero = true;
      return 0;
    }
    block.end = now.position;
    if (axis_command_ != Command::length) {
      const Point zero = after.zero();
      each_axis([&](Axis axis, double value) {
        value *= is_rotary(axis) ? 1 : unit;
        block.end[axis] = value + (other_ == 530 ? 0 : after.distance == 90 ? zero[axis] : now.position[axis]);
      });
    }
    if (other_ == 280 || other_ == 300) {
      const Point& stored = other_ == 280 ? now.g28 : now.g30;
      block.home = stored;
      if (has_axes()) {
        for (const char letter : axes) {
          if (!word(letter)) (*block.home)[*axis_of(letter)] = now.position[*axis_of(letter)];
        }
        block.move = 0;
      }
    }
    if (other_ == 530 && after.motion != 0 && after.motion != 1) return 30;
    return 0;
  }
  int check_g10(const GrblBoardModes& now, GrblBoardBlock& block, double unit) {
    if (!has_axes()) return 26;
    if (!word('P') && !word('L')) return 28;
    const int which = static_cast<int>(word('P').value_or(0));
    const int kind = static_cast<int>(word('L').value_or(0));
    if (which > 6) return 29;
    if (kind != 20 && kind != 2) return 20;
    if (kind == 2 && word('R')) return 20;
    words_[slot('L')] = words_[slot('P')] = {};
    const std::size_t index = static_cast<std::size_t>(which > 0 ? which - 1 : block.after.system - 54);
    Point& system = block.after.systems[index];
    each_axis([&](Axis axis, double value) {
      system[axis] = value * unit;
      if (kind == 2) return;
      system[axis] = now.position[axis] - now.g92[axis] - value * unit - (axis == Axis::z ? now.tool_length : 0);
    });
    block.stored_bytes = 12;
    block.changes_zero = true;
    return 0;
  }
  int check_motion(const GrblBoardModes& now, GrblBoardBlock& block, double unit) {
    const int motion = block.after.motion;
    if (motion != 0 && block.feed == 0) return 22;
    if (motion == 0 || motion == 1) {
      if (has_axes()) block.move = motion;
      if (!has_axes()) axis_command_ = Command::none;
      return 0;
    }
    if (!has_axes()) return 26;
    block.move = motion;
    if (motion >= 382) return block.end == now.position ? 33 : 0;
    return check_arc(now, block, unit);
  }
  int check_arc(const GrblBoardModes& now, GrblBoardBlock& block, double unit) {
    const int plane = block.after.plane;
    block.first = plane == 17 ? Axis::x : plane == 18 ? Axis::z : Axis::y;
    block.second = plane == 17 ? Axis::y : plane == 18 ? Axis::x : Axis::z;
    if (!word(letter_of(block.first)) && !word(letter_of(block.second))) return 32;
    double x = block.end[block.first] - now.position[block.first];
    double y = block.end[block.second] - now.position[block.second];
    if (word('R')) {
      const double radius = take('R') * unit;
      if (block.end == now.position) return 33;
      const double height2 = 4 * radius * radius - x * x - y * y;
      if (height2 < 0) return 34;
      double part = -std::sqrt(height2) / std::hypot(x, y);
      if (block.after.motion == 3) part = -part;
      if (radius < 0) part = -part;
      block.center[block.first] = (x - y * part) / 2;
      block.center[block.second] = (y + x * part) / 2;
      return 0;
    }
    const char of_first = static_cast<char>('I' + static_cast<int>(block.first));
    const char of_second = static_cast<char>('I' + static_cast<int>(block.second));
    if (!word(of_first) && !word(of_second)) return 35;
    block.center[block.first] = word(of_first).value_or(0) * unit;
    block.center[block.second] = word(of_second).value_or(0) * unit;
    for (const char letter : {'I', 'J', 'K'}) words_[slot(letter)] = {};
    x -= block.center[block.first];
    y -= block.center[block.second];
    const double radius = std::hypot(block.center[block.first], block.center[block.second]);
    const double off = std::abs(std::hypot(x, y) - radius);
    return off > 0.005 && (off > 0.5 || off > 0.001 * radius) ? 33 : 0;
  }

  // What the block does to the modes.
  int finish(bool jog, const GrblBoardModes& now, GrblBoardBlock& block) {
    GrblBoardModes& after = block.after;
    if (jog) {
      constexpr unsigned allowed = 1U << 0U | 1U << 3U | 1U << 6U;
      if ((groups_ & ~allowed) != 0 || (other_ != 0 && other_ != 530)) return 16;
      const Point end = block.end;
      after = now;
      after.position = end;
      return 0;
    }
    block.inverse_time = after.feed_mode == 93;
    after.feed = block.feed;
    block.changes_outputs = after.spindle != now.spindle || (after.speed != now.speed && now.spindle != 5) ||
                            after.flood != now.flood || after.mist != now.mist;
    if (axis_command_ == Command::length) {
      const double length = sets_length_ ? length_ : 0;
      block.changes_zero = block.changes_zero || length != now.tool_length;
      after.tool_length = length;
    }
    block.changes_zero = block.changes_zero || after.system != now.system;
    if (other_ == 921) {
      after.g92 = {};
      block.changes_zero = true;
    }
    if (other_ == 281 || other_ == 301) {
      (other_ == 281 ? after.g28 : after.g30) = now.position;
      block.stored_bytes = 12;
    }
    if (block.move && *block.move < 382) after.position = block.end;
    if (block.home) after.position = *block.home;
    block.flow = flow_;
    after.tool = static_cast<int>(word('T').value_or(0));
    return 0;
  }
  template <class Use>
  void each_axis(Use use) const {
    for (const char letter : axes) {
      if (word(letter)) use(*axis_of(letter), *word(letter));
    }
  }

  std::array<std::optional<double>, 26> words_{};
  unsigned groups_ = 0;
  Command axis_command_ = Command::none;
  int other_ = 0;  // code of group 0, times ten
  bool sets_length_ = false;
  double length_ = 0;
  int flow_ = -1;
};

}  // namespace passo
