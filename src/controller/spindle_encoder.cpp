#include "passo/controller/spindle_encoder.hpp"

#include <algorithm>
#include <cmath>

namespace passo {
namespace {

// From one index to the next a board may be off by so much: it looks at the two one after the other.
constexpr double good_turn = 0.02;
constexpr double good_counts = 2;
constexpr double worst_turn = 0.3;
// One may be missed. Damage that looks like a reading is rare, but not never: it must be wrong twice.
constexpr double turns_without_index = 4;
constexpr int surely_wrong = 2;
// A shaft at rest may tremble on the edge of a count.
constexpr double trembling = 1.5;

double difference(std::uint32_t a, std::uint32_t b) {
  return static_cast<double>(static_cast<std::int32_t>(a - b));
}

}  // namespace

void SpindleEncoder::read(const SpindleCount& count) {
  if (last_) {
    now_.time += Seconds(difference(count.tick, last_->tick) / clock_.value());
    now_.turns += difference(count.count, last_->count) / counts_per_turn_;
  }
  if (std::abs(now_.turns - moved_to_) * counts_per_turn_ > trembling) {
    moved_to_ = now_.turns;
    moved_at_ = now_.time;
  }
  if (last_ && count.indexes != last_->indexes) {
    const double index = now_.turns + difference(count.at_index, count.count) / counts_per_turn_;
    if (index_) {
      const double turns = index - *index_;
      const double off = std::abs(turns - std::round(turns));
      const bool good =
          std::round(turns) != 0 && off <= std::clamp(good_counts / counts_per_turn_, good_turn, worst_turn);
      wrong_ = good ? 0 : wrong_ + 1;
    }
    index_ = indexed_at_ = index;
  }
  last_ = count;
}

bool SpindleEncoder::is_wrong() const {
  return wrong_ >= surely_wrong || std::abs(now_.turns - indexed_at_) > turns_without_index;
}

}  // namespace passo
