// SentSegments: the last segments sent to a board, and the step pulses that result from them, each with its time.
//
// Within a motion, the times are those of the board's player, to the tick, because the host computes the same event
// times. If the queue was empty, the next motion starts at its sending time by the host's clock, which is a few
// milliseconds early. Segments that are queued on the board but not executed yet are included; a view shows no pulses
// later than now.
//
// At most `most` segments are kept; the oldest are dropped. Cost: about 100 ns per segment, nothing while switched off.
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
  Seconds begin{0};                                  // start of the window
  Seconds end{0};                                    // end of the window
  Seconds oldest{0};                                 // start of the kept segments
  Seconds newest{0};                                 // end of the kept segments, at most now
  std::array<std::int32_t, max_motors> counts = {};  // the motors' steps since the hello, at `begin`
  std::vector<BoardPulse> pulses = {};
};

class SentSegments {
 public:
  static constexpr std::size_t most = 8192;

  // Starts keeping segments. `rate`: the board's timer frequency; 0: stops keeping them.
  void keep(Hertz rate);
  bool keeps() const { return tick_.value() > 0; }
  // After a handshake: fractions and counts start at zero.
  void begin(std::uint8_t motors);
  void add(std::uint16_t number, const BoardSegment& segment, Seconds now);
  // The items after this one are not executed.
  void drop_behind(std::uint16_t number);

  // The probe has stopped the board: later events are not executed.
  void stop(Seconds now);
  // Sets the step counts that the board has reported while stopped.
  void stand_at(const std::int32_t* counts);

  // Pulses from `from` to `to`, at most `most_pulses`, and none later than now. They reach up to the window's `end`.
  PulseWindow window(Seconds from, Seconds to, Seconds now, std::size_t most_pulses) const;

 private:
  // The start of a segment.
  struct Place {
    std::int64_t time = 0;  // in 1/65536 tick
    std::array<std::uint16_t, max_motors> fractions = {};
    std::array<std::int32_t, max_motors> counts = {};
  };
  struct Kept {
    std::uint16_t number = 0;
    BoardSegment segment = {};
    Place place = {};
    std::int64_t until = INT64_MAX;  // in 1/65536 tick: later events are not executed
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
