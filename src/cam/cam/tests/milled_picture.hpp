// MilledPicture: an oracle for programs of isolation milling. It draws the copper in pixels, moves a disc along the
// feed moves of the program's text, and floods what is left. It shares no code with the planner or its proof.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace passo::test {

class MilledPicture {
 public:
  using Corners = std::vector<std::pair<double, double>>;  // mm

  // A box in mm, and the side of a pixel.
  MilledPicture(double left, double low, double right, double high, double pixel)
      : left_(left),
        low_(low),
        pixel_(pixel),
        columns_(static_cast<int>((right - left) / pixel) + 1),
        rows_(static_cast<int>((high - low) / pixel) + 1),
        copper_(size()),
        milled_(size()) {}

  // Rings of copper: a pixel is copper if a ray from its middle crosses an odd number of their edges.
  void draw_copper(const std::vector<Corners>& rings) {
    for (int row = 0; row < rows_; ++row) {
      const double y = low_ + (row + 0.5) * pixel_ + 1e-7;
      std::vector<double> crossings;
      for (const Corners& ring : rings) {
        for (std::size_t i = 0, last = ring.size() - 1; i < ring.size(); last = i++) {
          const auto& [x0, y0] = ring[last];
          const auto& [x1, y1] = ring[i];
          if ((y0 <= y) != (y1 <= y)) crossings.push_back(x0 + (y - y0) / (y1 - y0) * (x1 - x0));
        }
      }
      std::sort(crossings.begin(), crossings.end());
      for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
        const int from = std::max(0, static_cast<int>(std::ceil((crossings[i] - left_) / pixel_ - 0.5)));
        const int to = std::min(columns_ - 1, static_cast<int>(std::floor((crossings[i + 1] - left_) / pixel_ - 0.5)));
        for (int column = from; column <= to; ++column) copper_[at(column, row)] = 1;
      }
    }
  }
  void set_copper(int column, int row) { copper_[at(column, row)] = 1; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }

  // The feed moves below Z0 of a program in mm, with absolute places and arcs by their centres.
  void mill(const std::string& program, double cutter) {
    std::array<double, 3> place{0, 0, 1};
    int code = 0;
    std::istringstream lines(program);
    for (std::string line; std::getline(lines, line);) {
      if (line.find('(') != std::string::npos) line.erase(line.find('('));
      std::array<double, 3> next = place;
      double i = 0;
      double j = 0;
      bool moves = false;
      for (const char* text = line.c_str(); *text != 0;) {
        const char letter = *text++;
        char* end = nullptr;
        const double value = std::strtod(text, &end);
        if (end == text) continue;
        text = end;
        if (letter == 'G' && value <= 3) code = static_cast<int>(value);
        if (letter >= 'X' && letter <= 'Z') next[static_cast<std::size_t>(letter - 'X')] = value;
        moves = moves || (letter >= 'X' && letter <= 'Z');
        if (letter == 'I') i = value;
        if (letter == 'J') j = value;
      }
      if (moves && code > 0 && next[2] < 0) sweep(place, next, code, i, j, cutter / 2);
      place = next;
    }
  }

  // The connected pieces of what is left, 4 neighbours each. Returns for each place its piece; -1: milled or beside the
  // picture.
  std::vector<int> pieces_at(const Corners& places) {
    std::vector<int> piece(size(), -1);
    int pieces = 0;
    std::vector<std::size_t> open;
    for (std::size_t start = 0; start < size(); ++start) {
      if (milled_[start] != 0 || piece[start] >= 0) continue;
      open.push_back(start);
      piece[start] = pieces;
      while (!open.empty()) {
        const std::size_t here = open.back();
        open.pop_back();
        const int column = static_cast<int>(here % static_cast<std::size_t>(columns_));
        const auto go = [&](bool may, std::size_t next) {
          if (!may || milled_[next] != 0 || piece[next] >= 0) return;
          piece[next] = pieces;
          open.push_back(next);
        };
        const auto wide = static_cast<std::size_t>(columns_);
        go(column > 0, here - 1);
        go(column + 1 < columns_, here + 1);
        go(here >= wide, here - wide);
        go(here + wide < size(), here + wide);
      }
      ++pieces;
    }
    std::vector<int> found;
    for (const auto& [x, y] : places) {
      const int column = static_cast<int>((x - left_) / pixel_);
      const int row = static_cast<int>((y - low_) / pixel_);
      const bool is_in = column >= 0 && row >= 0 && column < columns_ && row < rows_;
      found.push_back(is_in ? piece[at(column, row)] : -1);
    }
    return found;
  }

  bool is_copper_left(double x, double y) const {
    const std::size_t pixel = at(static_cast<int>((x - left_) / pixel_), static_cast<int>((y - low_) / pixel_));
    return copper_[pixel] != 0 && milled_[pixel] == 0;
  }

  bool is_milled(double x, double y) const {
    return milled_[at(static_cast<int>((x - left_) / pixel_), static_cast<int>((y - low_) / pixel_))] != 0;
  }

  double lost_mm2() const {
    std::size_t lost = 0;
    for (std::size_t i = 0; i < size(); ++i) lost += copper_[i] != 0 && milled_[i] != 0 ? 1 : 0;
    return static_cast<double>(lost) * pixel_ * pixel_;
  }

  // How far from the next pixel without copper a lost pixel lies, at most; up to `reach`.
  double deepest_loss(double reach) const {
    double deepest = 0;
    const int far = static_cast<int>(reach / pixel_) + 1;
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        if (copper_[at(column, row)] == 0 || milled_[at(column, row)] == 0) continue;
        double nearest = reach;
        for (int y = std::max(0, row - far); y <= std::min(rows_ - 1, row + far); ++y) {
          for (int x = std::max(0, column - far); x <= std::min(columns_ - 1, column + far); ++x) {
            if (copper_[at(x, y)] == 0) nearest = std::min(nearest, std::hypot(x - column, y - row) * pixel_);
          }
        }
        deepest = std::max(deepest, nearest);
      }
    }
    return deepest;
  }

 private:
  std::size_t size() const { return static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_); }
  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }

  void sweep(const std::array<double, 3>& from, const std::array<double, 3>& to, int code, double i, double j,
             double radius) {
    if (code == 1) return sweep_line(from[0], from[1], to[0], to[1], radius);
    const double x = from[0] + i;
    const double y = from[1] + j;
    const double arc = std::hypot(i, j);
    const double start = std::atan2(-j, -i);
    double turn = std::atan2(to[1] - y, to[0] - x) - start;
    if (code == 2 && turn >= 0) turn -= 2 * M_PI;
    if (code == 3 && turn <= 0) turn += 2 * M_PI;
    const int chords = 1 + static_cast<int>(std::abs(turn) / 2 / std::acos(std::max(0.0, 1 - 2e-4 / arc)));
    for (int k = 0; k < chords; ++k) {
      const double a = start + turn * k / chords;
      const double b = start + turn * (k + 1) / chords;
      sweep_line(x + arc * std::cos(a), y + arc * std::sin(a), x + arc * std::cos(b), y + arc * std::sin(b), radius);
    }
  }

  void sweep_line(double x0, double y0, double x1, double y1, double radius) {
    const int low = std::max(0, static_cast<int>((std::min(y0, y1) - radius - low_) / pixel_));
    const int high = std::min(rows_ - 1, static_cast<int>((std::max(y0, y1) + radius - low_) / pixel_));
    const double squared = (x1 - x0) * (x1 - x0) + (y1 - y0) * (y1 - y0);
    for (int row = low; row <= high; ++row) {
      const double y = low_ + (row + 0.5) * pixel_;
      // Only the part of the line that is near this row.
      double first = 0;
      double second = 1;
      if (std::abs(y1 - y0) > 1e-12) {
        const double a = (y - radius - y0) / (y1 - y0);
        const double b = (y + radius - y0) / (y1 - y0);
        first = std::max(0.0, std::min(a, b));
        second = std::min(1.0, std::max(a, b));
        if (first > second) continue;
      }
      const double xa = x0 + first * (x1 - x0);
      const double xb = x0 + second * (x1 - x0);
      const int from = std::max(0, static_cast<int>((std::min(xa, xb) - radius - left_) / pixel_));
      const int to = std::min(columns_ - 1, static_cast<int>((std::max(xa, xb) + radius - left_) / pixel_));
      for (int column = from; column <= to; ++column) {
        const double x = left_ + (column + 0.5) * pixel_;
        const double share =
            squared > 0 ? std::clamp(((x - x0) * (x1 - x0) + (y - y0) * (y1 - y0)) / squared, 0.0, 1.0) : 0;
        const double dx = x0 + share * (x1 - x0) - x;
        const double dy = y0 + share * (y1 - y0) - y;
        if (dx * dx + dy * dy <= radius * radius) milled_[at(column, row)] = 1;
      }
    }
  }

  double left_;
  double low_;
  double pixel_;
  int columns_;
  int rows_;
  std::vector<std::uint8_t> copper_;
  std::vector<std::uint8_t> milled_;
};

}  // namespace passo::test
