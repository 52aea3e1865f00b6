// Reads from canonical text where a program ends, in machine coordinates. This reader of `passo canon`'s output shares
// no code with the pipeline.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace passo::oracle {

class CanonEnd {
 public:
  // One line of canonical text.
  void read(const std::string& line) {
    const std::size_t open = line.find('(');
    if (open == std::string::npos) return;
    std::size_t name_start = line.find_last_of(' ', open);
    name_start = name_start == std::string::npos ? 0 : name_start + 1;
    const std::string name = line.substr(name_start, open - name_start);
    const std::vector<double> values = numbers(line.substr(open + 1));
    if (name == "USE_LENGTH_UNITS") {
      scale_ = line.find("INCHES") != std::string::npos ? 25.4 : 1;
    } else if (name == "SET_G5X_OFFSET") {
      keep(values, 1, work_offset_);
    } else if (name == "SET_G92_OFFSET") {
      keep(values, 0, g92_offset_);
    } else if (name == "USE_TOOL_LENGTH_OFFSET") {
      keep(values, 0, tool_offset_);
    } else if (name == "SET_XY_ROTATION") {
      rotation_ = values.at(0) * std::numbers::pi / 180;
    } else if (name == "SELECT_PLANE") {
      plane_ = line.find("PLANE_XZ") != std::string::npos ? 1 : line.find("PLANE_YZ") != std::string::npos ? 2 : 0;
    } else if (name == "STRAIGHT_TRAVERSE" || name == "STRAIGHT_FEED") {
      for (std::size_t i = 0; i < 6; ++i) work_[i] = values.at(i) * (i < 3 ? scale_ : 1);
      moved_ = true;
    } else if (name == "ARC_FEED") {
      // (first end, second end, first centre, second centre, turns, axis end, a, b, c)
      constexpr std::array<std::array<std::size_t, 3>, 3> axes = {{{0, 1, 2}, {2, 0, 1}, {1, 2, 0}}};
      work_[axes[plane_][0]] = values.at(0) * scale_;
      work_[axes[plane_][1]] = values.at(1) * scale_;
      work_[axes[plane_][2]] = values.at(5) * scale_;
      for (std::size_t i = 3; i < 6; ++i) work_[i] = values.at(i + 3);
      moved_ = true;
    }
    if (moved_) place();
  }

  // X Y Z A B C of the last move.
  const std::array<double, 6>& machine_end() const { return end_; }
  double scale() const { return scale_; }

 private:
  // Between commas or blanks.
  static std::vector<double> numbers(std::string text) {
    std::replace(text.begin(), text.end(), ',', ' ');
    std::vector<double> values;
    std::stringstream stream(text);
    std::string part;
    while (stream >> part) values.push_back(std::strtod(part.c_str(), nullptr));
    return values;
  }
  void keep(const std::vector<double>& values, std::size_t first, std::array<double, 6>& offset) const {
    for (std::size_t i = 0; i < 6; ++i) offset[i] = values.at(first + i) * (i < 3 ? scale_ : 1);
  }
  void place() {
    std::array<double, 6> p = work_;
    for (std::size_t i = 0; i < 6; ++i) p[i] += g92_offset_[i];
    const double x = p[0] * std::cos(rotation_) - p[1] * std::sin(rotation_);
    const double y = p[0] * std::sin(rotation_) + p[1] * std::cos(rotation_);
    p[0] = x;
    p[1] = y;
    for (std::size_t i = 0; i < 6; ++i) end_[i] = p[i] + work_offset_[i] + tool_offset_[i];
    moved_ = false;
  }

  double scale_ = 1;
  double rotation_ = 0;
  std::size_t plane_ = 0;
  bool moved_ = false;
  std::array<double, 6> work_{};
  std::array<double, 6> work_offset_{};
  std::array<double, 6> g92_offset_{};
  std::array<double, 6> tool_offset_{};
  std::array<double, 6> end_{};
};

}  // namespace passo::oracle
