// RandomTrouble: disturbs data like a bad link.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "passo/wire/decoder.hpp"
#include "passo/wire/encoder.hpp"

namespace passo::test {

using Bytes = std::vector<std::uint8_t>;

// Loses, duplicates and flips bytes. Loses and swaps frames.
class RandomTrouble {
 public:
  explicit RandomTrouble(std::uint64_t seed) : random_(seed), rate_(between(0.0001, 0.001)) {}

  Bytes operator()(bool to_board, const Bytes& bytes) {
    Bytes passed;
    if (!chance(4 * rate_)) {
      for (const std::uint8_t byte : bytes) {
        if (chance(rate_)) {
          ++faults;
          const double kind = between(0, 3);
          if (kind < 1) continue;
          if (kind < 2) passed.push_back(byte);
          passed.push_back(kind < 2 ? byte
                                    : static_cast<std::uint8_t>(byte ^ 1U << static_cast<unsigned>(between(0, 8))));
          continue;
        }
        passed.push_back(byte);
      }
    } else {
      ++faults;
    }
    Bytes& late = late_[to_board ? 0 : 1];
    if (late.empty() && chance(4 * rate_)) {
      ++faults;
      late = std::move(passed);
      return {};
    }
    passed.insert(passed.end(), late.begin(), late.end());
    late.clear();
    return passed;
  }
  int faults = 0;

 private:
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  bool chance(double share) { return between(0, 1) < share; }

  std::mt19937_64 random_;
  double rate_;
  std::array<Bytes, 2> late_;  // frames to be swapped with the next frame; one for each direction
};

// Returns the frame with a changed payload and the matching CRC. Nothing if the frame is neither an item nor a queue
// update. `which` selects the bit of the payload that changes.
inline std::optional<Bytes> forged(const Bytes& bytes, std::uint8_t which) {
  constexpr std::uint8_t motors = 3;
  Decoder decoder;
  decoder.set_motors(motors);
  Decoded told = Decoded::pending;
  for (const std::uint8_t byte : bytes) told = decoder.feed(byte);
  if (told != Decoded::frame) return {};
  WireFrame frame = decoder.frame();
  if (frame.type != MessageType::segment && frame.type != MessageType::replace) return {};
  const std::uint8_t size = payload_size(static_cast<std::uint8_t>(frame.type), motors);
  frame.payload[which / 8 % size] ^= static_cast<std::uint8_t>(1U << which % 8);
  Bytes other(largest_frame);
  Encoder encoder(other.data(), frame.type, frame.sequence);
  for (std::uint8_t i = 0; i < size; ++i) encoder.put8(frame.payload[i]);
  other.resize(encoder.finish());
  return other;
}

}  // namespace passo::test
