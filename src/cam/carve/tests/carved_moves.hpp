// Reads the programs of reliefs back move by move and checks them against the oracle: shared by the tests of whole
// programs.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "gouge_oracle.hpp"
#include <gtest/gtest.h>

#include "passo/carve/relief_program.hpp"

namespace passo::test {

struct ReadMove {
  bool is_rapid = false;
  bool is_arc = false;  // a chord of an arc
  double from[3] = {};
  double to[3] = {};
  double feed = 0;
  std::size_t tool = 1;  // from 1; before the first tool change, the first tool
  std::size_t line = 0;  // line of the program
};

// Reads a program. Arcs become chords that deviate by at most 0.1 um.
class ProgramReader {
 public:
  std::vector<ReadMove> read(const std::string& program) {
    for (std::size_t begin = 0; begin < program.size();) {
      const std::size_t end = program.find('\n', begin);
      ++line_;
      read_line(program.substr(begin, end - begin));
      begin = end + 1;
    }
    return std::move(moves_);
  }

 private:
  void read_line(const std::string& line) {
    if (line.find("M6") != std::string::npos) ++tool_;
    if (line.empty() || line[0] == '(' || line[0] == 'M' || line[0] == 'T' || line.starts_with("G17 G21") ||
        line.starts_with("G4")) {
      return;
    }
    double to[3] = {at_[0], at_[1], at_[2]};
    double centre[3] = {at_[0], at_[1], at_[2]};
    for (std::size_t i = 0; i < line.size();) {
      const char letter = line[i];
      std::size_t used = 0;
      const double value = std::stod(line.substr(i + 1), &used);
      if (letter == 'G' && value <= 3) motion_ = static_cast<int>(value);
      if (letter == 'G' && value >= 17) plane_ = static_cast<int>(value);
      if (letter == 'F') feed_ = value;
      if (letter >= 'X' && letter <= 'Z') to[letter - 'X'] = value;
      if (letter >= 'I' && letter <= 'K') centre[letter - 'I'] += value;
      if (letter == 'X') knows_x_ = true;
      i += 1 + used;
      while (i < line.size() && line[i] == ' ') ++i;
    }
    if (motion_ < 2) {
      add(to, false);
    } else if (line.find_first_of("IJK") != std::string::npos) {
      add_arc(to, centre);
    }
  }

  void add(const double (&to)[3], bool is_arc) {
    ReadMove move{.is_rapid = motion_ == 0,
                  .is_arc = is_arc,
                  .feed = feed_,
                  .tool = std::max<std::size_t>(1, tool_),
                  .line = line_};
    std::copy_n(at_, 3, move.from);
    std::copy_n(to, 3, move.to);
    std::copy_n(to, 3, at_);
    if (knows_x_) moves_.push_back(move);
  }

  void add_arc(const double (&to)[3], const double (&centre)[3]) {
    const int first = plane_ == 17 ? 0 : plane_ == 18 ? 2 : 1;
    const int second = (first + 1) % 3;
    const int other = (first + 2) % 3;
    const auto angle = [&](const double* at) {
      return std::atan2(at[second] - centre[second], at[first] - centre[first]);
    };
    const auto radius = [&](const double* at) {
      return std::hypot(at[second] - centre[second], at[first] - centre[first]);
    };
    const double start = angle(at_);
    double sweep = angle(to) - start;
    if (motion_ == 3 && sweep <= 0) sweep += 2 * std::numbers::pi;
    if (motion_ == 2 && sweep >= 0) sweep -= 2 * std::numbers::pi;
    const double from_radius = radius(at_);
    const double to_radius = radius(to);
    EXPECT_NEAR(from_radius, to_radius, 2e-4) << "line " << line_;
    const double from_other = at_[other];
    const int parts = static_cast<int>(std::ceil(std::abs(sweep) * std::sqrt(from_radius / 8e-4))) + 1;
    for (int i = 1; i <= parts; ++i) {
      const double share = static_cast<double>(i) / parts;
      const double here = from_radius + (to_radius - from_radius) * share;
      double place[3];
      place[first] = centre[first] + here * std::cos(start + sweep * share);
      place[second] = centre[second] + here * std::sin(start + sweep * share);
      place[other] = from_other + (to[other] - from_other) * share;
      add(i < parts ? place : to, true);
    }
  }

  std::vector<ReadMove> moves_;
  double at_[3] = {0, 0, 1000};
  double feed_ = 0;
  int motion_ = 0;
  int plane_ = 17;
  bool knows_x_ = false;
  std::size_t tool_ = 0;
  std::size_t line_ = 0;
};

inline std::vector<ReadMove> moves_of(const std::string& program) {
  return ProgramReader().read(program);
}

struct Written {
  std::string text;
  ReliefReport report;
};
inline Written written(const HeightGrid& grid, const ReliefProgramOptions& options, bool wants_carved = false) {
  Written program;
  program.report = write_relief(
      grid, options, [&](std::string_view text) { program.text += text; }, [](double) {}, wants_carved);
  return program;
}

inline const OracleCutter& oracle_of(const char* text) {
  for (const OracleCutter& cutter : oracle_cutters()) {
    if (std::string(cutter.text) == text) return cutter;
  }
  return oracle_cutters().front();
}

// `every`: checks one of this many positions along the moves. `least`: number of positions.
inline void expect_no_gouge(const HeightGrid& grid, const std::string& program, const std::vector<OracleCutter>& tools,
                            int every, int least = 1000) {
  int places = 0;
  for (const ReadMove& move : moves_of(program)) {
    const OracleCutter& cutter = tools[tools.size() > 1 ? move.tool - 1 : 0];
    const double length = std::hypot(move.to[0] - move.from[0], move.to[1] - move.from[1]);
    const int parts = std::max(1, static_cast<int>(length / 0.07));
    for (int i = 0; i <= parts; ++i) {
      if (++places % every != 0 && !move.is_rapid) continue;
      const double share = static_cast<double>(i) / parts;
      const auto at = [&](int axis) { return move.from[axis] + (move.to[axis] - move.from[axis]) * share; };
      ASSERT_GE(at(2), least_tip(grid, cutter, at(0), at(1), 3) - 1.5e-4)
          << cutter.text << " at X" << at(0) << " Y" << at(1) << (move.is_rapid ? ", a rapid" : "") << ", line "
          << move.line;
    }
  }
  EXPECT_GT(places, least);
}

inline ReliefProgramOptions options_of(const char* cutter) {
  ReliefProgramOptions options;
  options.finish.cutter = *parse_cutter(cutter);
  options.finish.step_over = Mm(0.6);
  options.tolerance = Mm(0.02);
  return options;
}

inline HeightGrid hills(std::size_t columns, std::size_t rows, double pitch, double high = 1.5) {
  HeightGrid grid{.columns = columns, .rows = rows, .pitch_x = Mm(pitch), .pitch_y = Mm(pitch)};
  for (std::size_t y = 0; y < rows; ++y) {
    for (std::size_t x = 0; x < columns; ++x) {
      const double u = static_cast<double>(x) * pitch;
      const double v = static_cast<double>(y) * pitch;
      grid.heights.push_back(grid_height(Mm(-2.5 + high * std::sin(u * 1.3) * std::cos(v * 1.1) + (u > 5 ? 1 : 0))));
    }
  }
  return grid;
}

inline ReliefProgramOptions three_tools() {
  ReliefProgramOptions options = options_of("ball:3");
  options.roughing =
      ReliefRoughing{.tool = {.cutter = *parse_cutter("flat:2.3")}, .step_down = Mm(1), .stock = Mm(0.2)};
  options.rest = ReliefRest{.tool = {.cutter = *parse_cutter("taper:1:10:3")}};
  return options;
}

// The stock as heights on a fine grid, cut by each position of the tool.
class OracleStock {
 public:
  // `fine`: distance between the points, mm.
  OracleStock(double width, double length, double fine = 0.1)
      : fine_(fine), columns_(places(width)), rows_(places(length)) {
    heights_.assign(columns_ * rows_, 0);
  }

  // Returns how deep the cutter is in the stock. `share`: the fraction of its radius that is considered.
  double depth_of(const OracleCutter& cutter, double x, double y, double z, double share = 1) const {
    double deepest = 0;
    const OracleCutter inner{cutter.text, cutter.radius * share, cutter.height};
    each(inner, x, y, [&](std::size_t i, double height) { deepest = std::max(deepest, heights_[i] - z - height); });
    return deepest;
  }
  // Returns the removed volume, mm³.
  double cut(const OracleCutter& cutter, double x, double y, double z) {
    double taken = 0;
    each(cutter, x, y, [&](std::size_t i, double height) {
      const double low = std::min(heights_[i], z + height);
      taken += heights_[i] - low;
      heights_[i] = low;
    });
    return taken * fine_ * fine_;
  }
  double at(double x, double y) const {
    return heights_[static_cast<std::size_t>((y + beyond) / fine_) * columns_ +
                    static_cast<std::size_t>((x + beyond) / fine_)];
  }

 private:
  static constexpr double beyond = 3.5;
  std::size_t places(double size) const { return static_cast<std::size_t>((size + 2 * beyond) / fine_) + 1; }

  template <class Act>
  void each(const OracleCutter& cutter, double x, double y, const Act& act) const {
    const auto first = [&](double at) {
      return static_cast<std::size_t>(std::max(0.0, (at - cutter.radius + beyond) / fine_));
    };
    const auto end = [&](double at, std::size_t most) {
      return std::min(most, static_cast<std::size_t>(std::max(0.0, (at + cutter.radius + beyond) / fine_)) + 1);
    };
    for (std::size_t j = first(y); j < end(y, rows_); ++j) {
      const double dy = static_cast<double>(j) * fine_ - beyond - y;
      for (std::size_t i = first(x); i < end(x, columns_); ++i) {
        const double away = std::hypot(static_cast<double>(i) * fine_ - beyond - x, dy);
        if (away <= cutter.radius) act(j * columns_ + i, cutter.height(away));
      }
    }
  }

  double fine_;
  std::size_t columns_;
  std::size_t rows_;
  std::vector<double> heights_;
};

}  // namespace passo::test
