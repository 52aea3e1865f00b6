// TurnedHandwheel: the lines of a handwheel that is turned forth and back, for pins of an emulated chip.
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>

namespace passo::test {

class TurnedHandwheel {
 public:
  // `rate`: edges a second while it is turned. The distances of edges differ by half: its lines are not exactly a
  // quarter of a period apart.
  TurnedHandwheel(double cycles_a_second, double rate, std::uint64_t seed)
      : cycles_between_edges_(cycles_a_second / rate), random_(seed) {}

  // Turns it by an edge. Returns the number of cycles until the next one.
  std::uint64_t turn() {
    if (left_ == 0) {
      way_ = -way_;
      left_ = 20 + static_cast<int>(random_() % 300);
    }
    --left_;
    position_ += way_;
    ++edges_;
    const double share = position_ % 2 == 0 ? 0.75 : 1.25;
    return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(cycles_between_edges_ * share));
  }
  bool a() const { return (position_ & 3) == 0 || (position_ & 3) == 3; }
  bool b() const { return (position_ & 3) <= 1; }
  std::int64_t position() const { return position_; }
  std::int64_t edges() const { return edges_; }

 private:
  double cycles_between_edges_;
  std::mt19937_64 random_;
  std::int64_t position_ = 0;  // both lines are high
  std::int64_t edges_ = 0;
  int way_ = -1;
  int left_ = 0;
};

}  // namespace passo::test
