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

  friend bool operator==(const CarvedPlace&, const CarvedPlace&) = default;
};
inline constexpr double carved_units = 1e4;  // a millimetre

struct CarvingFeeds {
  Mm along{1000};  // a minute
  Mm down{300};    // the most that the tip goes down, a minute
};

// What a tool's part of the program is.
struct CarvingCost {
  std::uint64_t moves = 0;  // in work
  std::uint64_t arcs = 0;   // of these
  double cut_mm = 0;
  double rapid_mm = 0;
  double feed_minutes = 0;
};

// A move in work: a line, or an arc in one of the three planes. The axis that is not in the plane moves in proportion.
struct CarvedCut {
  enum class Kind : std::uint8_t { line, arc_xy, arc_zx, arc_yz };
  Kind kind = Kind::line;
  bool counterclockwise = false;  // G3; seen from the end of the axis that is not in the plane
  CarvedPlace from = {};
  CarvedPlace to = {};
  CarvedPlace centre = {};  // of an arc; what is not in its plane does not count
};

// The radius of an arc at its start, and the angle that it turns, above 0 and at most a full turn.
struct CarvedSweep {
  double radius = 0;  // mm
  double angle = 0;   // radians
};
CarvedSweep sweep_of(const CarvedCut& arc);
double length_of(const CarvedCut& cut);  // mm
// `share`: of the way, 0 to 1.
CarvedPlace place_on(const CarvedCut& cut, double share);
// How steeply the tip goes down where it does so most, as a share of its way: 0 to 1.
double steepest_down(const CarvedCut& cut);

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
  const CarvingFeeds& feeds() const { return feeds_; }
  // Who takes the moves in work in place of the writer, and hands them on to write() in their order. Before anything
  // else is written, `settle` must have handed on all. Empty: nobody.
  struct Taker {
    std::function<void(const CarvedCut&)> take = {};
    std::function<void()> settle = {};
  };
  void set_taker(Taker taker) { taker_ = std::move(taker); }
  // From here on, nothing is known of the tool's place but its height.
  void begin_at(std::int64_t z);
  void rapid_to(std::int64_t x, std::int64_t y);
  void rapid_up_down(std::int64_t z);
  void cut_to(const CarvedPlace& to);
  // The arc begins where the tool is.
  void arc_to(CarvedCut arc);
  const CarvedPlace& place() const { return at_; }
  // The feed at which the tip goes down slowly enough, in carved units a minute. `share`: of the usual feed.
  std::int64_t feed_of(const CarvedCut& cut, double share = 1) const;
  // The same in mm a minute, where that share of the way goes down.
  double feed_down(double down, double share = 1) const;
  // Writes a move that begins where the one before ends.
  void write(const CarvedCut& cut, std::int64_t feed);
  // The plane of arcs is XY again (G17), as at the program's start.
  void restore_plane();
  // What was counted since the last call.
  CarvingCost take_cost() { return std::exchange(cost_, {}); }
  // Hands on what was written.
  void flush();

 private:
  void hand_on(const CarvedCut& cut);
  void settle();
  void begin_word();
  void word(char letter, std::int64_t value);
  void motion(char code);
  void plane(CarvedCut::Kind kind);
  void end_line();

  Sink sink_;
  std::string text_;
  CarvingFeeds feeds_;
  CarvingCost cost_;
  Taker taker_;
  CarvedPlace at_;
  bool knows_xy_ = false;
  char motion_ = 0;
  CarvedCut::Kind plane_ = CarvedCut::Kind::arc_xy;
  std::int64_t feed_ = 0;  // in carved units a minute
};

}  // namespace passo
