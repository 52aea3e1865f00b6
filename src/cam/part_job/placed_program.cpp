#include "passo/part_job/placed_program.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>

#include <fmt/format.h>

namespace passo {
namespace {

struct ProgramWord {
  char letter = 0;
  std::string_view text;  // with the letter
  double value = 0;
};

// The words of a line. Empty: a comment, or an empty line.
std::vector<ProgramWord> words_of(std::string_view line) {
  std::vector<ProgramWord> words;
  while (!line.empty()) {
    const std::size_t begin = line.find_first_not_of(' ');
    if (begin == std::string_view::npos || line[begin] == '(') break;
    line.remove_prefix(begin);
    const std::size_t end = std::min(line.find(' '), line.size());
    ProgramWord word{.letter = line.front(), .text = line.substr(0, end)};
    std::from_chars(word.text.data() + 1, word.text.data() + word.text.size(), word.value);
    words.push_back(word);
    line.remove_prefix(end);
  }
  return words;
}

std::string number_words(double value) {
  constexpr double finest = 1e5;
  return fmt::format("{:.10g}", std::round(value * finest) / finest + 0.0);
}

std::string_view next_line(std::string_view& rest) {
  const std::size_t end = std::min(rest.find('\n'), rest.size());
  const std::string_view line = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return line;
}

bool is_tool_change(std::string_view line) {
  return line.starts_with('T') && line.ends_with(" M6");
}

bool is_tool_message(std::string_view line) {
  return line.starts_with("(MSG, tool");
}

// A turn; quarter turns are exact.
class Turn {
 public:
  explicit Turn(double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    cosine_ = std::cos(angle);
    sine_ = std::sin(angle);
    if (const double quarters = degrees / 90; quarters == std::floor(quarters)) {
      cosine_ = std::round(cosine_);
      sine_ = std::round(sine_);
    }
  }
  ProgramPoint of(const ProgramPoint& point) const {
    return {point.x * cosine_ - point.y * sine_, point.x * sine_ + point.y * cosine_, point.z};
  }

 private:
  double cosine_ = 1;
  double sine_ = 0;
};

// Where the tip is, from line to line.
struct TipState {
  ProgramPoint at = {};
  double z = 0;
  int motion = 0;  // of G0 to G3; 80: none; otherwise a canned cycle
};

}  // namespace

bool can_be_turned(std::string_view program) {
  return program.find("G18") == std::string_view::npos && program.find("G19") == std::string_view::npos;
}

std::string placed_program(std::string_view program, const ProgramPlace& place, std::string_view park) {
  const Turn turn(place.degrees);
  const std::string to_park = fmt::format("G0 {}", park);
  std::string placed;
  placed.reserve(program.size() + program.size() / 4);
  ProgramPoint at;
  while (!program.empty()) {
    const std::string_view line = next_line(program);
    const bool is_park = line == to_park && (program.empty() || program.starts_with("M2") || program.front() == '(');
    const std::vector<ProgramWord> words = is_park ? std::vector<ProgramWord>() : words_of(line);
    ProgramPoint centre;
    bool moves = false;
    bool has_centre = false;
    for (const ProgramWord& word : words) {
      if (word.letter == 'X') at.x = word.value;
      if (word.letter == 'Y') at.y = word.value;
      if (word.letter == 'I') centre.x = word.value;
      if (word.letter == 'J') centre.y = word.value;
      moves = moves || word.letter == 'X' || word.letter == 'Y';
      has_centre = has_centre || word.letter == 'I' || word.letter == 'J';
    }
    if (!moves && !has_centre) {
      placed.append(line).append("\n");
      continue;
    }
    const ProgramPoint to = turn.of(at);
    const ProgramPoint about = turn.of(centre);
    std::string text;
    const auto add = [&](std::string_view word) {
      if (!text.empty()) text += ' ';
      text += word;
    };
    for (const ProgramWord& word : words) {
      if (word.letter == 'X' || word.letter == 'Y') {
        if (moves) add(fmt::format("X{} Y{}", number_words(to.x + place.x), number_words(to.y + place.y)));
        moves = false;
      } else if (word.letter == 'I' || word.letter == 'J') {
        if (has_centre) add(fmt::format("I{} J{}", number_words(about.x), number_words(about.y)));
        has_centre = false;
      } else {
        add(word.text);
      }
    }
    placed.append(text).append("\n");
  }
  return placed;
}

std::vector<std::string> programs_of_tools(std::string_view program) {
  std::vector<std::string> programs;
  std::string begin;
  const std::string whole(program);
  while (!program.empty()) {
    const std::string_view line = next_line(program);
    if (is_tool_change(line)) programs.push_back(begin);
    if (is_tool_message(line)) continue;
    (programs.empty() ? begin : programs.back()).append(line).append("\n");
  }
  if (programs.size() < 2) return {whole};
  for (std::string& one : programs) {
    if (!one.ends_with("M2\n")) one += "M2\n";
  }
  return programs;
}

std::vector<ProgramPoint> cut_points_of(std::string_view program, double step) {
  std::vector<ProgramPoint> points;
  TipState tip;
  while (!program.empty()) {
    const std::vector<ProgramWord> words = words_of(next_line(program));
    TipState next = tip;
    ProgramPoint centre;
    bool moves = false;
    for (const ProgramWord& word : words) {
      const int code = static_cast<int>(word.value);
      if (word.letter == 'G' && (code <= 3 || (code >= 80 && code <= 89))) next.motion = code;
      if (word.letter == 'X') next.at.x = word.value;
      if (word.letter == 'Y') next.at.y = word.value;
      if (word.letter == 'Z') next.z = word.value;
      if (word.letter == 'I') centre.x = word.value;
      if (word.letter == 'J') centre.y = word.value;
      moves = moves || (word.letter >= 'X' && word.letter <= 'Z') || word.letter == 'I' || word.letter == 'J';
    }
    if (moves && next.motion > 80) {
      points.push_back({next.at.x, next.at.y, next.z});
      next.z = tip.z;  // a cycle ends above the stock
    } else if (moves && next.motion >= 1 && next.motion <= 3 && std::min(tip.z, next.z) < 0) {
      const ProgramPoint middle{tip.at.x + centre.x, tip.at.y + centre.y};
      const double radius = std::hypot(centre.x, centre.y);
      const double first = std::atan2(tip.at.y - middle.y, tip.at.x - middle.x);
      double sweep = std::atan2(next.at.y - middle.y, next.at.x - middle.x) - first;
      constexpr double whole_turn = 2 * std::numbers::pi;
      if (next.motion == 2 && sweep > -1e-9) sweep -= whole_turn;
      if (next.motion == 3 && sweep < 1e-9) sweep += whole_turn;
      const bool is_arc = next.motion > 1;
      const double length = is_arc ? std::abs(sweep) * radius : std::hypot(next.at.x - tip.at.x, next.at.y - tip.at.y);
      constexpr double most_pieces = 10'000;
      const int pieces = static_cast<int>(std::clamp(std::ceil(length / step), 1.0, most_pieces));
      for (int i = 0; i <= pieces; ++i) {
        const double share = static_cast<double>(i) / pieces;
        const double angle = first + sweep * share;
        ProgramPoint point{.x = tip.at.x + share * (next.at.x - tip.at.x),
                           .y = tip.at.y + share * (next.at.y - tip.at.y),
                           .z = tip.z + share * (next.z - tip.z)};
        if (is_arc) {
          point.x = middle.x + radius * std::cos(angle);
          point.y = middle.y + radius * std::sin(angle);
        }
        points.push_back(point);
      }
    }
    tip = next;
  }
  return points;
}

}  // namespace passo
