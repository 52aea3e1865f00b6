#include "passo/drive/spindle_encoder.hpp"

#include <algorithm>
#include <cmath>

namespace passo {
namespace {

// How much an index may be off, because the board reads the count after the index.
constexpr double good_turn = 0.02;
constexpr Seconds good_time{0.002};
constexpr double good_counts = 2;
constexpr double worst_turn = 0.3;
// An index may be missed. A damaged message rarely looks like a good reading, but that does happen. So two readings in
// a row must be wrong, or every second one.
constexpr double turns_without_index = 4;
constexpr int surely_wrong = 4;
// In counts. A shaft at rest may tremble on the edge of a count.
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
    if (!first_index_) first_index_ = index;
    if (index_) record_turns(index - *first_index_, std::abs(index - *index_) / (now_.time - indexed_then_).value());
    indexed_then_ = now_.time;
    index_ = indexed_at_ = index;
  }
  last_ = count;
}

// `turns` counts from the first index, so that counts lost bit by bit add up.
void SpindleEncoder::record_turns(double turns, double speed) {
  const double most = std::max(good_turn + speed * good_time.value(), good_counts / counts_per_turn_);
  const bool good = std::abs(turns - std::round(turns)) <= std::min(most, worst_turn);
  doubts_ = good ? std::max(doubts_ - 1, 0) : doubts_ + 2;
  known_good_ = known_good_ || good;
}

bool SpindleEncoder::is_wrong() const {
  return doubts_ >= surely_wrong || std::abs(now_.turns - indexed_at_) > turns_without_index;
}

}  // namespace passo
