// JogLease: how long a jog may go on without being asked for again. A jog without a lease has no end of its own.
// Private to session/.
#pragma once

#include <optional>

#include "passo/units/units.hpp"

namespace passo {

class JogLease {
 public:
  void begin(Seconds length, Seconds now) {
    length_ = length;
    renew(now);
  }
  void renew(Seconds now) { end_ = now + length_; }
  // Whether motion that is made until then would outlast the lease.
  bool is_over_at(Seconds time) const { return end_ && time > *end_; }

 private:
  Seconds length_{0};
  std::optional<Seconds> end_;
};

}  // namespace passo
