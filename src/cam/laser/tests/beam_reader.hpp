// read_beam: an independent reader of the programs of laser/. It follows the modal words as Grbl 1.1 does, and knows
// nothing of how they were written.
#pragma once

#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace passo::test {

struct BeamMove {
  double x0 = 0;
  double y0 = 0;
  double x = 0;
  double y = 0;
  double i = 0;
  double j = 0;
  int motion = 0;
  double s = 0;  // 0 while the beam is off
  double f = 0;  // mm/min
};

struct BeamProgram {
  std::vector<BeamMove> moves;
  std::vector<std::string> faults;  // empty: the beam is off where it has to be
  int start = 0;                    // M3 or M4
  std::vector<double> heights;      // Z words, in order
};

// Words of a line without its comments.
inline std::map<char, double> words_of(const std::string& line) {
  std::map<char, double> words;
  bool is_comment = false;
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (line[k] == '(') is_comment = true;
    if (line[k] == ')') is_comment = false;
    if (is_comment || line[k] < 'A' || line[k] > 'Z') continue;
    words[line[k]] = std::strtod(line.c_str() + k + 1, nullptr);
  }
  return words;
}

inline BeamProgram read_beam(const std::string& text) {
  BeamProgram read;
  std::istringstream lines(text);
  int motion = -1;
  int spindle = 5;
  double x = 0;
  double y = 0;
  double s = 0;
  double f = 0;
  bool is_ended = false;
  for (std::string line; std::getline(lines, line);) {
    const auto fault = [&](const char* why) { read.faults.push_back(line + ": " + why); };
    const std::map<char, double> words = words_of(line);
    if (words.empty()) continue;
    if (is_ended) fault("follows the end");
    const auto value = [&](char letter, double otherwise) {
      const auto found = words.find(letter);
      return found == words.end() ? otherwise : found->second;
    };
    const double g = value('G', motion);
    if (g >= 0 && g <= 3) motion = static_cast<int>(g);
    const int m = static_cast<int>(value('M', -1));
    const bool moves = words.count('X') + words.count('Y') > 0;
    s = value('S', s);
    f = value('F', f);
    if (m == 3 || m == 4) {
      spindle = m;
      read.start = m;
      if (s != 0) fault("begins with the beam on");
    }
    if (m == 5) spindle = 5;
    if (m == 2) {
      is_ended = true;
      if (spindle != 5) fault("the beam is not switched off at the end");
    }
    const bool is_on = spindle != 5 && s > 0;
    if (words.count('Z') > 0) {
      read.heights.push_back(words.at('Z'));
      if (is_on) fault("the beam is on while Z moves");
    }
    if (!moves) {
      if (is_on && m != 5 && g != 4) fault("the beam is on at rest");
      continue;
    }
    if (motion < 0) fault("moves without a G word");
    if (motion == 0 && is_on) fault("the beam is on in a rapid");
    if (motion > 0 && f <= 0) fault("has no feed");
    BeamMove move{x, y, value('X', x), value('Y', y), value('I', 0), value('J', 0), motion, is_on ? s : 0, f};
    if (move.x0 == move.x && move.y0 == move.y && motion < 2 && read.moves.size() > 1) fault("goes nowhere");
    x = move.x;
    y = move.y;
    read.moves.push_back(move);
  }
  if (!is_ended) read.faults.emplace_back("the program has no end");
  return read;
}

}  // namespace passo::test
