#include "move_writer.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

namespace passo {
namespace {

double way_between(const CarvedPlace& from, const CarvedPlace& to) {
  const auto x = static_cast<double>(to.x - from.x);
  const auto y = static_cast<double>(to.y - from.y);
  const auto z = static_cast<double>(to.z - from.z);
  return std::sqrt(x * x + y * y + z * z) / carved_units;
}

// The axes of an arc's plane, in the order in which counterclockwise is positive.
struct PlaneAxes {
  std::int64_t CarvedPlace::*first = nullptr;
  std::int64_t CarvedPlace::*second = nullptr;
  std::int64_t CarvedPlace::*other = nullptr;
};
PlaneAxes axes_of(CarvedCut::Kind kind) {
  if (kind == CarvedCut::Kind::arc_zx) return {&CarvedPlace::z, &CarvedPlace::x, &CarvedPlace::y};
  if (kind == CarvedCut::Kind::arc_yz) return {&CarvedPlace::y, &CarvedPlace::z, &CarvedPlace::x};
  return {&CarvedPlace::x, &CarvedPlace::y, &CarvedPlace::z};
}

double angle_of(const CarvedCut& arc, const CarvedPlace& place, const PlaneAxes& axes) {
  return std::atan2(static_cast<double>(place.*axes.second - arc.centre.*axes.second),
                    static_cast<double>(place.*axes.first - arc.centre.*axes.first));
}

}  // namespace

CarvedSweep sweep_of(const CarvedCut& arc) {
  constexpr double turn = 2 * std::numbers::pi;
  const PlaneAxes axes = axes_of(arc.kind);
  const double from = angle_of(arc, arc.from, axes);
  const double to = angle_of(arc, arc.to, axes);
  double angle = arc.counterclockwise ? to - from : from - to;
  while (angle <= 0) angle += turn;
  while (angle > turn) angle -= turn;
  const double radius = std::hypot(static_cast<double>(arc.from.*axes.first - arc.centre.*axes.first),
                                   static_cast<double>(arc.from.*axes.second - arc.centre.*axes.second));
  return {radius / carved_units, angle};
}

double length_of(const CarvedCut& cut) {
  if (cut.kind == CarvedCut::Kind::line) return way_between(cut.from, cut.to);
  const PlaneAxes axes = axes_of(cut.kind);
  const CarvedSweep sweep = sweep_of(cut);
  return std::hypot(sweep.radius * sweep.angle,
                    static_cast<double>(cut.to.*axes.other - cut.from.*axes.other) / carved_units);
}

CarvedPlace place_on(const CarvedCut& cut, double share) {
  if (share >= 1) return cut.to;
  const auto between = [&](std::int64_t from, std::int64_t to) {
    return from + std::llround(static_cast<double>(to - from) * share);
  };
  if (cut.kind == CarvedCut::Kind::line) {
    return {between(cut.from.x, cut.to.x), between(cut.from.y, cut.to.y), between(cut.from.z, cut.to.z)};
  }
  const PlaneAxes axes = axes_of(cut.kind);
  const CarvedSweep sweep = sweep_of(cut);
  const double turned = (cut.counterclockwise ? 1 : -1) * sweep.angle * share;
  const double angle = angle_of(cut, cut.from, axes) + turned;
  CarvedPlace place;
  place.*axes.first = cut.centre.*axes.first + std::llround(sweep.radius * carved_units * std::cos(angle));
  place.*axes.second = cut.centre.*axes.second + std::llround(sweep.radius * carved_units * std::sin(angle));
  place.*axes.other = between(cut.from.*axes.other, cut.to.*axes.other);
  return place;
}

// An arc in an upright plane is steepest at one of its ends: it turns by less than a half, and no tangent of it is
// upright.
double steepest_down(const CarvedCut& cut) {
  if (cut.kind == CarvedCut::Kind::line || cut.kind == CarvedCut::Kind::arc_xy) {
    const double length = length_of(cut);
    return length > 0 ? std::max(0.0, static_cast<double>(cut.from.z - cut.to.z) / carved_units / length) : 0;
  }
  const std::int64_t CarvedPlace::*const level =
      cut.kind == CarvedCut::Kind::arc_zx ? &CarvedPlace::x : &CarvedPlace::y;
  const double ahead = cut.to.*level > cut.from.*level ? 1 : -1;
  const auto down_at = [&](const CarvedPlace& place) {
    const auto out = static_cast<double>(place.*level - cut.centre.*level);
    const auto up = static_cast<double>(place.z - cut.centre.z);
    const double radius = std::hypot(out, up);
    // Below its centre an arc goes down on the way towards the centre, above it on the way from it.
    return radius > 0 ? (up > 0 ? 1 : -1) * ahead * out / radius : 0;
  };
  return std::max({0.0, down_at(cut.from), down_at(cut.to)});
}

// Without zeros at the end: "X12.5", "Z-0.0003".
void MoveWriter::word(char letter, std::int64_t value) {
  begin_word();
  char digits[32];
  char* to = digits;
  *to++ = letter;
  if (value < 0) *to++ = '-';
  const auto size = static_cast<std::uint64_t>(value < 0 ? -value : value);
  constexpr auto one = static_cast<std::uint64_t>(carved_units);
  to = std::to_chars(to, digits + sizeof(digits), size / one).ptr;
  std::uint64_t fraction = size % one;
  if (fraction != 0) {
    *to++ = '.';
    for (std::uint64_t place = one / 10; fraction != 0; place /= 10) {
      *to++ = static_cast<char>('0' + fraction / place);
      fraction %= place;
    }
  }
  text_.append(digits, to);
}

void MoveWriter::begin_word() {
  if (!text_.empty() && text_.back() != '\n') text_ += ' ';
}

void MoveWriter::motion(char code) {
  if (motion_ == code) return;
  motion_ = code;
  begin_word();
  text_ += 'G';
  text_ += code;
}

void MoveWriter::plane(CarvedCut::Kind kind) {
  if (plane_ == kind) return;
  plane_ = kind;
  begin_word();
  text_ += kind == CarvedCut::Kind::arc_zx ? "G18" : kind == CarvedCut::Kind::arc_yz ? "G19" : "G17";
}

void MoveWriter::restore_plane() {
  if (plane_ == CarvedCut::Kind::arc_xy) return;
  plane(CarvedCut::Kind::arc_xy);
  end_line();
}

void MoveWriter::end_line() {
  text_ += '\n';
  constexpr std::size_t piece = 65536;
  if (text_.size() >= piece) flush();
}

void MoveWriter::flush() {
  sink_(text_);
  text_.clear();
}

void MoveWriter::settle() {
  if (taker_.settle) taker_.settle();
}

void MoveWriter::begin_at(std::int64_t z, std::int64_t above) {
  at_.z = z;
  above_ = above;
  knows_xy_ = false;
  motion_ = 0;
  feed_ = 0;
}

void MoveWriter::rapid_to(std::int64_t x, std::int64_t y) {
  settle();
  const CarvedPlace to{x, y, at_.z};
  if (knows_xy_ && to.x == at_.x && to.y == at_.y) return;
  if (knows_xy_) cost_.rapid_mm += way_between(at_, to);
  motion('0');
  if (!knows_xy_ || to.x != at_.x) word('X', x);
  if (!knows_xy_ || to.y != at_.y) word('Y', y);
  end_line();
  at_ = to;
  if (!knows_xy_ && above_ != at_.z) {
    word('Z', at_.z);
    end_line();
  }
  knows_xy_ = true;
}

void MoveWriter::rapid_up_down(std::int64_t z) {
  if (z == at_.z) return;
  settle();
  cost_.rapid_mm += std::abs(static_cast<double>(z - at_.z)) / carved_units;
  motion('0');
  word('Z', z);
  end_line();
  at_.z = z;
}

// Slower where the way leads down steeply, in twentieths of the feed.
double MoveWriter::feed_down(double down, double share) const {
  const double along = feeds_.along.value() * share;
  const double deep = std::min(feeds_.down.value(), along);
  if (down * along <= deep) return along;
  const double part = along / 20;
  return std::max(deep, std::floor(deep / down / part) * part);
}

std::int64_t MoveWriter::feed_of(const CarvedCut& cut, double share) const {
  const double feed = feed_down(steepest_down(cut), share);
  const auto tenths = std::max<std::int64_t>(1, static_cast<std::int64_t>(std::floor(feed * 10)));
  return tenths * static_cast<std::int64_t>(carved_units) / 10;
}

void MoveWriter::hand_on(const CarvedCut& cut) {
  at_ = cut.to;
  if (taker_.take) {
    taker_.take(cut);
  } else {
    write(cut, feed_of(cut));
  }
}

void MoveWriter::cut_to(const CarvedPlace& to) {
  if (to == at_) return;
  hand_on({.from = at_, .to = to});
}

void MoveWriter::arc_to(CarvedCut arc) {
  arc.from = at_;
  hand_on(arc);
}

void MoveWriter::write(const CarvedCut& cut, std::int64_t feed) {
  const bool is_line = cut.kind == CarvedCut::Kind::line;
  if (!is_line) plane(cut.kind);
  motion(is_line ? '1' : cut.counterclockwise ? '3' : '2');
  if (cut.to.x != cut.from.x) word('X', cut.to.x);
  if (cut.to.y != cut.from.y) word('Y', cut.to.y);
  if (cut.to.z != cut.from.z) word('Z', cut.to.z);
  if (!is_line) {
    if (cut.kind != CarvedCut::Kind::arc_yz) word('I', cut.centre.x - cut.from.x);
    if (cut.kind != CarvedCut::Kind::arc_zx) word('J', cut.centre.y - cut.from.y);
    if (cut.kind != CarvedCut::Kind::arc_xy) word('K', cut.centre.z - cut.from.z);
    ++cost_.arcs;
  }
  if (feed != feed_) word('F', feed);
  end_line();
  feed_ = feed;
  const double length = length_of(cut);
  ++cost_.moves;
  cost_.cut_mm += length;
  cost_.feed_minutes += length * carved_units / static_cast<double>(feed);
}

}  // namespace passo
