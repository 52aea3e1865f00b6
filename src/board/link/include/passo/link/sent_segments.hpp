// SentSegments: the segments that a board was sent last, and the pulses that the board makes of them, each with its
// time.
//
// Within a motion the times are those of the board's own player, to the tick: the host computes the same sums. Where
// the board had nothing to play, the next motion begins when it was sent, so between two motions the time is that of
// the host's clock, a few milliseconds early. What is on the board and not played yet is kept too, until the host
// replaces it; whoever shows pulses shows none later than now.
//
// At most `most` segments are kept, and the oldest are dropped. Cost: about 100 ns a segment; nothing while it is off.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include "passo/units/units.hpp"
#include "passo/wire/board_segment.hpp"

namespace passo {

// At this time the motors in `stepped` make a step; those that are also in `directions` step down.
struct BoardPulse {
  Seconds time{0};
  std::uint8_t stepped = 0;
  std::uint8_t directions = 0;
};

struct PulseWindow {
  Seconds begin{0};                                  // the pulses are those from here on
  Seconds end{0};                                    // and up to here
  Seconds oldest{0};                                 // where the kept ones begin
  Seconds newest{0};                                 // where they end, now at the latest
  std::array<std::int32_t, max_motors> counts = {};  // the motors' steps since the hello, at `begin`
  std::vector<BoardPulse> pulses = {};
};

class SentSegments {
 public:
  static constexpr std::size_t most = 8192;

  // `rate`: of the board's timer. From now on segments are kept. 0: none is.
  void keep(Hertz rate);
  bool keeps() const { return tick_.value() > 0; }
  // The board was greeted: fractions and counts begin again.
  void begin(std::uint8_t motors);
  void add(std::uint16_t number, const BoardSegment& segment, Seconds now);
  // The items behind this one are not played.
  void drop_behind(std::uint16_t number);

  // The probe has stopped the board: what would come later is not played.
  void stop(Seconds now);
  // Where the board stands, as it has told at rest.
  void stand_at(const std::int32_t* counts);

  // Pulses from `from` to `to`, at most `most_pulses` of them, and none later than now. The window's `end` says how far
  // they go.
  PulseWindow window(Seconds from, Seconds to, Seconds now, std::size_t most_pulses) const;

 private:
  // Where a segment begins.
  struct Place {
    std::int64_t time = 0;  // in 1/65536 tick
    std::array<std::uint16_t, max_motors> fractions = {};
    std::array<std::int32_t, max_motors> counts = {};
  };
  struct Kept {
    std::uint16_t number = 0;
    BoardSegment segment = {};
    Place place = {};
    std::int64_t until = INT64_MAX;  // in 1/65536 tick: later events are not played
  };

  Place after(const Place& place, const BoardSegment& segment) const;
  void list(const Kept& kept, Seconds from, Seconds to, std::size_t most_pulses, PulseWindow& window) const;
  Seconds time_of(std::int64_t time) const { return static_cast<double>(time >> 16) * tick_; }

  Seconds tick_{0};
  std::uint8_t motors_ = 0;
  std::deque<Kept> kept_;
  Place end_;  // of the last segment
};

}  // namespace passo
