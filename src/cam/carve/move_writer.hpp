// MoveWriter: writes the moves of a carving program as compact G-code, passes the text on in pieces, and counts its
// cost.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "passo/units/units.hpp"

namespace passo {

// A position in the program, in its smallest unit: 0.1 um.
struct CarvedPlace {
  std::int64_t x = 0;
  std::int64_t y = 0;
  std::int64_t z = 0;

  friend bool operator==(const CarvedPlace&, const CarvedPlace&) = default;
};
inline constexpr double carved_units = 1e4;  // per millimetre

struct CarvingFeeds {
  Mm along{1000};  // mm/min
  Mm down{300};    // maximum downward speed of the tip, mm/min
};

// The cost of one tool's part of the program.
struct CarvingCost {
  std::uint64_t moves = 0;  // cutting moves
  std::uint64_t arcs = 0;   // arcs among them
  double cut_mm = 0;
  double rapid_mm = 0;
  double feed_minutes = 0;
};

// A cutting move: a line, or an arc in one of the three planes. The axis outside the plane moves in proportion.
struct CarvedCut {
  enum class Kind : std::uint8_t { line, arc_xy, arc_zx, arc_yz };
  Kind kind = Kind::line;
  bool counterclockwise = false;  // G3; seen from the positive end of the axis outside the plane
  CarvedPlace from = {};
  CarvedPlace to = {};
  CarvedPlace centre = {};  // centre of an arc; the coordinate outside its plane is ignored
};

// The radius of an arc at its start, and its sweep angle, above 0 and at most a full circle.
struct CarvedSweep {
  double radius = 0;  // mm
  double angle = 0;   // radians
};
CarvedSweep sweep_of(const CarvedCut& arc);
double length_of(const CarvedCut& cut);  // mm
// Returns the position at a fraction of the move, 0 to 1.
CarvedPlace place_on(const CarvedCut& cut, double share);
// Returns the steepest descent of the tip along the move, as a fraction of the distance: 0 to 1.
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
  // Receives the cutting moves instead of the writer, and passes them to write() in order. Before anything else is
  // written, `settle` must have passed on all of them. Empty: no receiver.
  struct Taker {
    std::function<void(const CarvedCut&)> take = {};
    std::function<void()> settle = {};
  };
  void set_taker(Taker taker) { taker_ = std::move(taker); }
  // Begins with an unknown tool position at the height `above`. The first rapid leads across there, and then down to z.
  void begin_at(std::int64_t z, std::int64_t above);
  void rapid_to(std::int64_t x, std::int64_t y);
  void rapid_up_down(std::int64_t z);
  void cut_to(const CarvedPlace& to);
  // Adds an arc that begins at the tool's position.
  void arc_to(CarvedCut arc);
  const CarvedPlace& place() const { return at_; }
  // Returns the feed at which the tip's descent keeps its speed limit, in carved units per minute. `share`: fraction of
  // the usual feed.
  std::int64_t feed_of(const CarvedCut& cut, double share = 1) const;
  // The same in mm/min, for a move whose descent is the fraction `down` of its length.
  double feed_down(double down, double share = 1) const;
  // Writes a move that begins at the end of the previous one.
  void write(const CarvedCut& cut, std::int64_t feed);
  // Selects the XY plane again (G17), as at the start of the program.
  void restore_plane();
  // Returns the cost since the last call.
  CarvingCost take_cost() { return std::exchange(cost_, {}); }
  // Passes on the written text.
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
  std::int64_t above_ = 0;  // height before the first rapid
  bool knows_xy_ = false;
  char motion_ = 0;
  CarvedCut::Kind plane_ = CarvedCut::Kind::arc_xy;
  std::int64_t feed_ = 0;  // last feed, in carved units per minute
};

}  // namespace passo
