// JogKeepAlive: the keep-alive timeout of a jog. A jog without one continues until it is stopped. Private to session/.
#pragma once

#include <optional>

#include "passo/units/units.hpp"

namespace passo {

class JogKeepAlive {
 public:
  void begin(Seconds length, Seconds now) {
    length_ = length;
    renew(now);
  }
  void renew(Seconds now) { end_ = now + length_; }
  // Whether motion planned up to that time would outlast the keep-alive timeout.
  bool is_over_at(Seconds time) const { return end_ && time > *end_; }

 private:
  Seconds length_{0};
  std::optional<Seconds> end_;
};

}  // namespace passo
