#include "move_writer.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace passo {
namespace {

double length_of(const CarvedPlace& from, const CarvedPlace& to) {
  const auto x = static_cast<double>(to.x - from.x);
  const auto y = static_cast<double>(to.y - from.y);
  const auto z = static_cast<double>(to.z - from.z);
  return std::sqrt(x * x + y * y + z * z);
}

}  // namespace

// Without zeros at the end: "X12.5", "Z-0.0003".
void MoveWriter::word(char letter, std::int64_t value) {
  char digits[32];
  char* to = digits;
  if (!text_.empty() && text_.back() != '\n') *to++ = ' ';
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

void MoveWriter::motion(char code) {
  if (motion_ == code) return;
  motion_ = code;
  text_ += 'G';
  text_ += code;
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

void MoveWriter::begin_at(std::int64_t z) {
  at_.z = z;
  knows_xy_ = false;
  motion_ = 0;
  feed_ = 0;
}

void MoveWriter::rapid_to(std::int64_t x, std::int64_t y) {
  const CarvedPlace to{x, y, at_.z};
  if (knows_xy_ && to.x == at_.x && to.y == at_.y) return;
  if (knows_xy_) cost_.rapid_mm += length_of(at_, to) / carved_units;
  motion('0');
  if (!knows_xy_ || to.x != at_.x) word('X', x);
  if (!knows_xy_ || to.y != at_.y) word('Y', y);
  end_line();
  at_ = to;
  knows_xy_ = true;
}

void MoveWriter::rapid_up_down(std::int64_t z) {
  if (z == at_.z) return;
  cost_.rapid_mm += std::abs(static_cast<double>(z - at_.z)) / carved_units;
  motion('0');
  word('Z', z);
  end_line();
  at_.z = z;
}

// Slower where the way leads down steeply, in twentieths of the feed.
std::int64_t MoveWriter::feed_of(double length, double down) const {
  const double along = feeds_.along.value();
  const double deep = std::min(feeds_.down.value(), along);
  double feed = along;
  if (down * along > deep * length) {
    const double part = along / 20;
    feed = std::max(deep, std::floor(deep * length / down / part) * part);
  }
  return static_cast<std::int64_t>(std::floor(feed * 10)) * static_cast<std::int64_t>(carved_units) / 10;
}

void MoveWriter::cut_to(const CarvedPlace& to) {
  const double length = length_of(at_, to);
  if (length == 0) return;
  const std::int64_t feed = feed_of(length, static_cast<double>(at_.z - to.z));
  motion('1');
  if (to.x != at_.x) word('X', to.x);
  if (to.y != at_.y) word('Y', to.y);
  if (to.z != at_.z) word('Z', to.z);
  if (feed != feed_) word('F', feed);
  end_line();
  feed_ = feed;
  at_ = to;
  ++cost_.moves;
  cost_.cut_mm += length / carved_units;
  cost_.feed_minutes += length / static_cast<double>(feed);
}

}  // namespace passo
