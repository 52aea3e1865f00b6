// MoveWriter: the lines of a carving program, as short as G-code allows, handed on in pieces. Counts what they cost.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "passo/units/units.hpp"

namespace passo {

// A place in the program, in its smallest unit: 0.1 um.
struct CarvedPlace {
  std::int64_t x = 0;
  std::int64_t y = 0;
  std::int64_t z = 0;
};
inline constexpr double carved_units = 1e4;  // a millimetre

struct CarvingFeeds {
  Mm along{1000};  // a minute
  Mm down{300};    // the most that the tip goes down, a minute
};

// What a tool's part of the program is.
struct CarvingCost {
  std::uint64_t moves = 0;  // in work
  double cut_mm = 0;
  double rapid_mm = 0;
  double feed_minutes = 0;
};

class MoveWriter {
 public:
  using Sink = std::function<void(std::string_view)>;
  explicit MoveWriter(Sink sink) : sink_(std::move(sink)) {}

  template <class... T>
  void line(fmt::format_string<T...> words, T&&... values) {
    fmt::format_to(std::back_inserter(text_), words, std::forward<T>(values)...);
    text_ += '\n';
  }
  void set_feeds(const CarvingFeeds& feeds) { feeds_ = feeds; }
  // From here on, nothing is known of the tool's place but its height.
  void begin_at(std::int64_t z);
  void rapid_to(std::int64_t x, std::int64_t y);
  void rapid_up_down(std::int64_t z);
  void cut_to(const CarvedPlace& to);
  const CarvedPlace& place() const { return at_; }
  // What was counted since the last call.
  CarvingCost take_cost() { return std::exchange(cost_, {}); }
  // Hands on what was written.
  void flush();

 private:
  void word(char letter, std::int64_t value);
  void motion(char code);
  void end_line();
  std::int64_t feed_of(double length, double down) const;

  Sink sink_;
  std::string text_;
  CarvingFeeds feeds_;
  CarvingCost cost_;
  CarvedPlace at_;
  bool knows_xy_ = false;
  char motion_ = 0;
  std::int64_t feed_ = 0;  // in carved units a minute
};

}  // namespace passo
