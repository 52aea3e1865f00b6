#include "svg_path.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>

#include "svg_words.hpp"

namespace passo {
namespace {

SvgSpot operator+(SvgSpot a, SvgSpot b) {
  return {a.x + b.x, a.y + b.y};
}
SvgSpot mirrored_at(SvgSpot middle, SvgSpot spot) {
  return {2 * middle.x - spot.x, 2 * middle.y - spot.y};
}

// From the ends of an arc to its centre. Source: SVG 2, appendix B.2.4.
std::optional<SvgArc> arc_between(SvgSpot from, SvgSpot to, double rx, double ry, double turn, bool is_large,
                                  bool is_positive) {
  rx = std::abs(rx);
  ry = std::abs(ry);
  if (rx == 0 || ry == 0) return std::nullopt;
  const double c = std::cos(turn);
  const double s = std::sin(turn);
  const double hx = (from.x - to.x) / 2;
  const double hy = (from.y - to.y) / 2;
  const double x = (c * hx + s * hy) / rx;
  const double y = (-s * hx + c * hy) / ry;
  const double far = x * x + y * y;
  if (!(far > 0)) return std::nullopt;
  if (far > 1) {  // the ellipse is too small to reach: it grows
    rx *= std::sqrt(far);
    ry *= std::sqrt(far);
  }
  const double reach = std::min(far, 1.0);
  const double off = std::sqrt(std::max(0.0, (1 - reach) / reach)) * (is_large == is_positive ? -1 : 1);
  // On the unit circle the arc goes from (a) to (b), about (off * y, -off * x).
  const double shrunk = far > 1 ? 1 / std::sqrt(far) : 1;
  const SvgSpot unit_centre{off * y * shrunk, -off * x * shrunk};
  const SvgSpot a{x * shrunk - unit_centre.x, y * shrunk - unit_centre.y};
  const SvgSpot b{-x * shrunk - unit_centre.x, -y * shrunk - unit_centre.y};
  double sweep = std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
  if (is_positive && sweep < 0) sweep += 2 * std::numbers::pi;
  if (!is_positive && sweep > 0) sweep -= 2 * std::numbers::pi;
  if (far >= 1) sweep = is_positive ? std::numbers::pi : -std::numbers::pi;
  SvgArc arc{.major = {rx * c, rx * s}, .minor = {-ry * s, ry * c}, .start = std::atan2(a.y, a.x), .sweep = sweep};
  arc.centre = {(from.x + to.x) / 2 + unit_centre.x * arc.major.x + unit_centre.y * arc.minor.x,
                (from.y + to.y) / 2 + unit_centre.x * arc.major.y + unit_centre.y * arc.minor.y};
  return arc;
}

class SvgPathReader {
 public:
  SvgPathReader(std::string_view data, std::size_t most, std::vector<SvgSubpath>& subpaths)
      : words_(data), most_(most), subpaths_(subpaths) {}

  std::optional<SvgPathFlaw> read() {
    if (words_.rest() == "none") return std::nullopt;
    char command = '\0';
    while (!words_.at_end()) {
      const char next = words_.peek();
      if (std::isalpha(static_cast<unsigned char>(next)) != 0) {
        words_.drop();
        command = next;
      } else if (command == '\0' || command == 'z' || command == 'Z') {
        return flaw("a command of a path: M, L, H, V, C, S, Q, T, A or Z");
      }
      if (subpaths_.empty() && command != 'M' && command != 'm') return flaw("M, the start of a path");
      if (!obey(command)) return flaw(expected_);
      // More numbers after those of a move are lines.
      if (command == 'M') command = 'L';
      if (command == 'm') command = 'l';
      if (++pieces_ > most_) return flaw("a shorter path");
    }
    return std::nullopt;
  }

 private:
  std::optional<SvgPathFlaw> flaw(std::string expected) const {
    return SvgPathFlaw{words_.place(), std::move(expected)};
  }

  bool number(double& value) {
    const std::optional<double> read = words_.number();
    if (read) value = *read;
    return read.has_value();
  }
  bool spot(SvgSpot& spot) {
    SvgSpot read;
    if (!number(read.x) || !number(read.y)) return false;
    spot = is_relative_ ? at_ + read : read;
    return true;
  }
  bool obey(char command);
  bool move();
  bool line(char command);
  bool curve(char command);
  bool arc();
  void close();
  void add(SvgPiece piece) {
    // After a path was closed, the next one begins where that one began.
    if (subpaths_.back().is_closed) subpaths_.push_back({.start = at_});
    at_ = piece.end;
    subpaths_.back().pieces.push_back(std::move(piece));
  }

  SvgWords words_;
  std::size_t most_;
  std::vector<SvgSubpath>& subpaths_;
  std::size_t pieces_ = 0;
  std::string expected_;
  SvgSpot at_;
  SvgSpot control_;  // the last one of the curve before
  char before_ = '\0';
  bool is_relative_ = false;
};

bool SvgPathReader::obey(char command) {
  is_relative_ = std::islower(static_cast<unsigned char>(command)) != 0;
  const char kind = static_cast<char>(std::toupper(static_cast<unsigned char>(command)));
  expected_ = std::string("the numbers of ") + command;
  bool is_good = false;
  switch (kind) {
    case 'M': is_good = move(); break;
    case 'L':
    case 'H':
    case 'V': is_good = line(kind); break;
    case 'C':
    case 'S':
    case 'Q':
    case 'T': is_good = curve(kind); break;
    case 'A': is_good = arc(); break;
    case 'Z':
      close();
      is_good = true;
      break;
    default: expected_ = "a command of a path: M, L, H, V, C, S, Q, T, A or Z"; break;
  }
  before_ = kind;
  return is_good;
}

bool SvgPathReader::move() {
  SvgSpot to;
  if (!spot(to)) return false;
  at_ = to;
  subpaths_.push_back({.start = to});
  return true;
}

bool SvgPathReader::line(char kind) {
  SvgSpot to = at_;
  if (kind == 'L') {
    if (!spot(to)) return false;
  } else {
    double value = 0;
    if (!number(value)) return false;
    double& along = kind == 'H' ? to.x : to.y;
    along = is_relative_ ? along + value : value;
  }
  add({.end = to});
  return true;
}

bool SvgPathReader::curve(char kind) {
  const bool is_cubic = kind == 'C' || kind == 'S';
  const bool goes_on = is_cubic ? before_ == 'C' || before_ == 'S' : before_ == 'Q' || before_ == 'T';
  std::vector<SvgSpot> control;
  if (kind == 'S' || kind == 'T') {
    control.push_back(goes_on ? mirrored_at(at_, control_) : at_);
  } else if (!spot(control.emplace_back())) {
    return false;
  }
  if (is_cubic && !spot(control.emplace_back())) return false;
  SvgSpot to;
  if (!spot(to)) return false;
  control_ = control.back();
  add({.end = to, .control = std::move(control)});
  return true;
}

bool SvgPathReader::arc() {
  double rx = 0;
  double ry = 0;
  double turn = 0;
  if (!number(rx) || !number(ry) || !number(turn)) return false;
  const std::optional<bool> is_large = words_.flag();
  const std::optional<bool> is_positive = is_large ? words_.flag() : std::nullopt;
  SvgSpot to;
  if (!is_positive || !spot(to)) return false;
  const auto arc = arc_between(at_, to, rx, ry, turn * std::numbers::pi / 180, *is_large, *is_positive);
  add({.end = to, .control = {}, .arc = arc});
  return true;
}

void SvgPathReader::close() {
  SvgSubpath& path = subpaths_.back();
  at_ = path.start;
  path.is_closed = true;
}

}  // namespace

SvgSpot SvgArc::at(double angle) const {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {centre.x + major.x * c + minor.x * s, centre.y + major.y * c + minor.y * s};
}

std::optional<SvgPathFlaw> read_svg_path(std::string_view data, std::size_t most, std::vector<SvgSubpath>& subpaths) {
  return SvgPathReader(data, most, subpaths).read();
}

}  // namespace passo
