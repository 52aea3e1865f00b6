#include "passo/cam/airfoil.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

#include "airfoil_spline.hpp"
#include "drawing_builder.hpp"
#include "text_lines.hpp"
#include <fmt/format.h>

#include "passo/base/counted.hpp"

namespace passo {
namespace {

constexpr std::size_t fewest_of_airfoil = 5;  // points
constexpr double farthest_of_airfoil = 1e5;

// Two numbers, and nothing else.
std::optional<AirfoilPoint> airfoil_point(std::string_view line) {
  AirfoilPoint point;
  std::string_view rest = line;
  for (double* const value : {&point.x, &point.y}) {
    rest = trimmed(rest);
    if (rest.starts_with(',')) rest = trimmed(rest.substr(1));
    if (rest.starts_with('+')) rest.remove_prefix(1);
    const auto [end, fault] = std::from_chars(rest.data(), rest.data() + rest.size(), *value);
    if (fault != std::errc() || !(std::abs(*value) <= farthest_of_airfoil)) return std::nullopt;
    rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
    // "1.0-0.5" is no pair.
    if (!rest.empty() && rest[0] != ' ' && rest[0] != '\t' && rest[0] != ',') return std::nullopt;
  }
  return trimmed(rest).empty() ? std::optional(point) : std::nullopt;
}

class AirfoilReader {
 public:
  AirfoilReader(const std::string& name, std::string_view text, Diagnostics& diagnostics)
      : name_(name), lines_(text), diagnostics_(diagnostics), builder_(name, diagnostics) {}

  Drawing read(Mm chord, AirfoilCurve curve);

 private:
  bool read_points();
  bool order_sides();
  bool smooth();
  void refuse(SourceLocation place, std::string_view line, std::string message, std::string expected);

  const std::string& name_;
  TextLines lines_;
  Diagnostics& diagnostics_;
  DrawingBuilder builder_;
  std::vector<AirfoilPoint> points_;
  std::optional<AirfoilPoint> counts_;  // of Lednicer's form
};

void AirfoilReader::refuse(SourceLocation place, std::string_view line, std::string message, std::string expected) {
  diagnostics_.add({.code = "airfoil.syntax",
                    .file = name_,
                    .place = place,
                    .message = std::move(message),
                    .expected = std::move(expected),
                    .text = std::string(line)});
}

bool AirfoilReader::read_points() {
  bool may_be_title = true;
  for (std::string_view line; lines_.next(line);) {
    const std::string_view words = trimmed(line);
    if (words.empty() || words.starts_with('#')) continue;
    const std::optional<AirfoilPoint> point = airfoil_point(words);
    if (!point) {
      if (!may_be_title || !points_.empty()) {
        refuse({lines_.number(), 1, 1}, line, "this is not a point of an airfoil", "X and Y, separated by spaces");
        return false;
      }
    } else if (points_.empty() && !counts_ && point->x > 1.5 && point->y > 1.5 && point->x == std::floor(point->x) &&
               point->y == std::floor(point->y)) {
      counts_ = point;
    } else {
      if (!builder_.has_room_for(1, {lines_.number(), 1, 1}, line)) return false;
      points_.push_back(*point);
    }
    // A title of more than one line is rare, but there is one.
    may_be_title = points_.empty();
  }
  return true;
}

// Lednicer's sides both begin at the nose: the upper one is turned round.
bool AirfoilReader::order_sides() {
  if (counts_) {
    const auto upper = static_cast<std::size_t>(counts_->x);
    if (upper + static_cast<std::size_t>(counts_->y) != points_.size()) {
      refuse({}, "",
             fmt::format("the file has {}, but declares {} and {}", counted(points_.size(), "point"), counts_->x,
                         counts_->y),
             "as many points as the second line declares");
      return false;
    }
    const auto middle = points_.begin() + static_cast<std::ptrdiff_t>(upper);
    std::reverse(points_.begin(), middle);
    const bool has_nose_twice = upper < points_.size() && std::hypot(points_[upper].x - points_[upper - 1].x,
                                                                     points_[upper].y - points_[upper - 1].y) < 1e-9;
    if (has_nose_twice) points_.erase(middle);
  }
  if (points_.size() >= fewest_of_airfoil) return true;
  refuse({}, "", "an airfoil of " + counted(points_.size(), "point"), "a name, then the points around the airfoil");
  return false;
}

// A spline from the trailing edge around the nose and back to the trailing edge.
bool AirfoilReader::smooth() {
  const auto is_same = [](const AirfoilPoint& a, const AirfoilPoint& b) { return a.x == b.x && a.y == b.y; };
  points_.erase(std::unique(points_.begin(), points_.end(), is_same), points_.end());
  const auto [least, most] = std::minmax_element(
      points_.begin(), points_.end(), [](const AirfoilPoint& a, const AirfoilPoint& b) { return a.x < b.x; });
  const double width = most->x - least->x;
  // Points that begin elsewhere are rotated, so that they begin and end there.
  if (most != points_.begin() && points_.back().x < most->x && points_.front().x < most->x) {
    if (is_same(points_.front(), points_.back())) points_.pop_back();
    std::rotate(points_.begin(),
                std::max_element(points_.begin(), points_.end(),
                                 [](const AirfoilPoint& a, const AirfoilPoint& b) { return a.x < b.x; }),
                points_.end());
    points_.push_back(points_.front());
  }
  constexpr double fine = 1e-5;  // of the chord
  if (points_.size() < 3) return true;
  std::vector<AirfoilPoint> curve = airfoil_spline(points_, fine * width);
  if (!builder_.has_room_for(curve.size(), {}, "")) return false;
  points_ = std::move(curve);
  return true;
}

Drawing AirfoilReader::read(Mm chord, AirfoilCurve curve) {
  if (!read_points() || !order_sides()) return builder_.take();
  const auto [least, most] = std::minmax_element(
      points_.begin(), points_.end(), [](const AirfoilPoint& a, const AirfoilPoint& b) { return a.x < b.x; });
  const double width = most->x - least->x;
  if (!(width > 1e-6)) {
    refuse({}, "", "all points of the airfoil have the same X", "X from the leading to the trailing edge");
    return builder_.take();
  }
  if (curve == AirfoilCurve::spline && !smooth()) return builder_.take();
  DrawnPath path{.is_closed = true, .layer = builder_.layer("")};
  for (const AirfoilPoint& point : points_) {
    const auto at = builder_.point(Mm(point.x * chord.value() / width), Mm(point.y * chord.value() / width), {}, "");
    if (!at) return builder_.take();
    if (path.points.empty() || path.points.back().at != *at) path.points.push_back({*at, 0});
  }
  if (path.points.size() > 1 && path.points.front().at == path.points.back().at) path.points.pop_back();
  builder_.add_path(std::move(path));
  return builder_.take();
}

}  // namespace

Drawing read_airfoil(const std::string& name, std::string_view text, Mm chord, Diagnostics& diagnostics,
                     AirfoilCurve curve) {
  return AirfoilReader(name, text, diagnostics).read(chord, curve);
}

bool looks_like_airfoil(std::string_view text) {
  constexpr std::size_t looked_at = 4096;
  constexpr int lines = 8;
  const std::string_view begin = text.substr(0, looked_at);
  if (begin.find('\0') != std::string_view::npos) return false;
  TextLines all(begin);
  std::string_view line;
  int pairs = 0;
  for (int i = 0; i < lines && all.next(line); ++i) {
    if (airfoil_point(line)) ++pairs;
  }
  return pairs >= 3;
}

}  // namespace passo
