// LivePlace: where the machine is while it moves, as its board tells now and then, and how fast.
#pragma once

#include <algorithm>
#include <optional>

#include "passo/geometry/euclid.hpp"
#include "passo/link/link.hpp"

namespace passo {

class LivePlace {
 public:
  const Point& at() const { return at_; }
  MmPerSecond speed() const { return speed_; }

  void rest_at(const Point& place) {
    at_ = place;
    speed_ = MmPerSecond(0);
  }
  // The board has told at that time that the machine is there. Without a time between, the speed stays.
  void hear(const Point& place, Seconds time) {
    const Seconds since = time - heard_;
    if (since > Seconds(0)) speed_ = Mm(distance(at_, place)) / since;
    at_ = place;
    heard_ = time;
  }
  bool is_news(Seconds time) const { return time != heard_; }

  // Whether the board is to be asked again. Whoever asked last counts: a board has little time to answer amid dense
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
