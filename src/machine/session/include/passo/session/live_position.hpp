// LivePosition: position and speed of a moving machine, from the board's occasional reports.
#pragma once

#include <algorithm>
#include <optional>

#include "passo/geometry/euclid.hpp"
#include "passo/link/link.hpp"

namespace passo {

class LivePosition {
 public:
  const Point& at() const { return at_; }
  MmPerSecond speed() const { return speed_; }

  void rest_at(const Point& place) {
    at_ = place;
    speed_ = MmPerSecond(0);
  }
  // Processes a reported position and its time. Without a time difference, the speed is kept.
  void hear(const Point& place, Seconds time) {
    const Seconds since = time - heard_;
    if (since > Seconds(0)) speed_ = Mm(distance(at_, place)) / since;
    at_ = place;
    heard_ = time;
  }
  bool is_news(Seconds time) const { return time != heard_; }

  // Whether to query the board again. Other queries count too, because a board has little time to answer during dense
  // motion.
  bool is_due(Seconds now, std::optional<Seconds> answered, Seconds between) const {
    return now - std::max(asked_, answered.value_or(asked_)) >= between;
  }
  void on_asked(Seconds now) { asked_ = now; }

 private:
  Point at_;
  MmPerSecond speed_{0};
  Seconds heard_{0};
  Seconds asked_{0};
};

}  // namespace passo
