// StopRampOptions: the amount of motion sent ahead to a board on a link, and the accuracy of its stop ramps (tails).
#pragma once

#include <cstddef>

#include "passo/stepgen/step_generator.hpp"

namespace passo {

struct StopRampOptions {
  Seconds horizon{0.1};          // motion before the stop ramp, after a queue update
  Seconds refill_at{0.06};       // the next queue update is sent when this much motion is left
  Seconds time_an_item{0.0005};  // transmission time; a queue update with many items is sent sooner
  Seconds longest_move{0.005};   // no planned move is longer
  // The accuracy of the segments. In the first milliseconds after a stop, motion exact to the tick needs hundreds more
  // segments per second than a serial link can carry. They would not fit into a short board queue either. Boards with
  // fewer places than `few_places`, and urgent motion, get the "in few places" kind.
  std::size_t few_places = 100;
  // On a board with a shorter queue, stop ramps have no jerk limits: with them, a stop ramp has two or three times as
  // many items, which a small board also processes slowly (decision 0108).
  std::size_t places_for_gentle_tails = 200;
  Exactness motion{.one_in = 64, .longest_segment = longest_segment_of_all};
  Exactness motion_in_few_places{
      .one_in = 2, .least_rate = Hertz(1'000), .longest_segment = longest_segment_of_all, .power_levels = 16};
  // A segment whose timing is off by a whole interval may decelerate twice as hard at its start as at its end.
  Exactness tail{.one_in = 4,
                 .least_rate = Hertz(0),
                 .longest_segment = longest_segment_of_all,
                 .ends_in_time = false,
                 .power_levels = 8};
  Exactness tail_in_few_places{.one_in = 1,
                               .least_rate = Hertz(0),
                               .longest_segment = longest_segment_of_all,
                               .ends_in_time = false,
                               .power_levels = 4};
};

}  // namespace passo
