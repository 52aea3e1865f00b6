#include <cmath>
#include <cstdlib>

#include "fitted_place.hpp"
#include "segment_fitter.hpp"

namespace passo {
namespace {

// In 1/65536 step. On a diagonal two motors are due at one event, and rounding decides which event that is.
constexpr double rounding = 1;

}  // namespace

// A motor may have more than a step to go until the first event: where another motor becomes the master, and the last
// event of the old one fell a little behind. A motor makes one step an event, so it would stay behind for as long as it
// leads, and no segment could serve two events. One more event half way makes up for it.
bool SegmentFitter::catch_up(const EventBuffer& events, const Stretch& stretch, const BoardModel& board, bool is_behind,
                             BoardSegment& segment) const {
  const std::int64_t time = events.time(0) - board.time();
  if (time < 2 * shortest_interval_) return false;
  std::array<Advance, max_motors> advances;
  for (unsigned m = 0; m < motors_; ++m) {
    const double place = events.places(m)[1];
    const double way = place - events.places(m)[0];
    const bool leads = m == stretch.master;
    const std::int64_t position = board.position(m);
    const bool moves = leads || std::fabs(way) >= still;
    const int sign = leads ? stretch.sign : moves ? (way > 0 ? 1 : -1) : (rest_place(place) > position ? 1 : -1);
    const std::int64_t from = sign > 0 ? position : ~position;
    std::int64_t to = from;
    if (leads) {
      to = std::llround(sign * place);
    } else if (moves) {
      to = static_cast<std::int64_t>(std::floor(sign * place + rounding));
    } else if (const std::int64_t rest = rest_place(place); (rest >> 16) != (position >> 16)) {
      to = sign > 0 ? rest : ~rest;
    }
    const std::int64_t missing = std::max<std::int64_t>(to - from, 0);
    if (missing > 2 * whole_step) return false;
    // The master is due at the line itself, another motor where it begins the step.
    const std::int64_t due = leads ? missing : (to & ~(whole_step - 1)) - from;
    is_behind = is_behind || due > whole_step;
    advances[m] = {.sign = missing > 0 ? sign : 0, .increment = (missing + 1) / 2};
  }
  if (!is_behind) return false;
  const std::uint8_t kept_directions = segment.directions;
  segment = BoardSegment{.events = 2, .interval = static_cast<std::uint32_t>(time / 2)};
  write(advances, kept_directions, segment);
  return true;
}

}  // namespace passo
