// ManInTheMiddle: disturbs the data between a host and a board with one kind of fault, in both directions.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <string_view>
#include <utility>

#include "kit/line_trouble.hpp"

namespace passo::test {

enum class Mischief : std::uint8_t {
  cut,      // a frame is truncated or lost
  flip,     // one bit is flipped
  doubled,  // a frame is duplicated
  swap,     // a frame arrives after the next one
  delay,    // a frame and all later ones are delayed by some frames, and then arrive in one piece
  garbage,  // inserts random bytes before or within a frame
};
inline constexpr std::array every_mischief = {Mischief::cut,  Mischief::flip,  Mischief::doubled,
                                              Mischief::swap, Mischief::delay, Mischief::garbage};
constexpr std::string_view name_of(Mischief mischief) {
  constexpr std::array<std::string_view, every_mischief.size()> names = {"cut",  "flip",  "doubled",
                                                                         "swap", "delay", "garbage"};
  return names[static_cast<std::size_t>(mischief)];
}

class ManInTheMiddle {
 public:
  // One in `to_board` frames to the board has a fault, and one in `to_host` pieces from the board. A chip sends byte by
  // byte, so there a piece is less than a frame.
  ManInTheMiddle(Mischief mischief, std::uint64_t seed, unsigned to_board = 25, unsigned to_host = 25)
      : mischief_(mischief), every_{to_board, to_host}, random_(seed) {}

  Bytes operator()(bool to_board, const Bytes& bytes) {
    const std::size_t way = to_board ? 0 : 1;
    Late& late = late_[way];
    if (late.frames > 0) {
      if (mischief_ == Mischief::swap) return release(late, bytes);
      late.bytes.insert(late.bytes.end(), bytes.begin(), bytes.end());
      return --late.frames > 0 ? Bytes() : release(late, Bytes());
    }
    if (bytes.empty() || below(every_[way]) != 0) return bytes;
    ++faults;
    if (to_board) ++faults_to_board;
    return spoil(late, bytes);
  }
  int faults = 0;  // number of faults in both directions
  int faults_to_board = 0;

 private:
  struct Late {
    Bytes bytes;
    unsigned frames = 0;  // number of frames until they arrive
  };

  std::size_t below(std::size_t end) { return std::uniform_int_distribution<std::size_t>(0, end - 1)(random_); }

  Bytes spoil(Late& late, Bytes bytes) {
    switch (mischief_) {
      case Mischief::cut: bytes.resize(below(bytes.size())); break;
      case Mischief::flip: bytes[below(bytes.size())] ^= static_cast<std::uint8_t>(1U << below(8)); break;
      case Mischief::doubled: {
        const Bytes again = bytes;
        bytes.insert(bytes.end(), again.begin(), again.end());
        break;
      }
      case Mischief::swap:
      case Mischief::delay:
        late = {.bytes = std::move(bytes),
                .frames = mischief_ == Mischief::swap ? 1U : static_cast<unsigned>(1 + below(6))};
        return {};
      case Mischief::garbage: {
        Bytes noise(1 + below(40));
        std::ranges::generate(noise, [this] { return static_cast<std::uint8_t>(below(256)); });
        const auto at = static_cast<std::ptrdiff_t>(below(2) == 0 ? 0 : below(bytes.size()));
        bytes.insert(bytes.begin() + at, noise.begin(), noise.end());
        break;
      }
    }
    return bytes;
  }

  static Bytes release(Late& late, Bytes before) {
    const Late all = std::exchange(late, {});
    before.insert(before.end(), all.bytes.begin(), all.bytes.end());
    return before;
  }

  Mischief mischief_;
  std::array<unsigned, 2> every_;
  std::mt19937_64 random_;
  std::array<Late, 2> late_;  // delayed frames, one entry for each direction
};

}  // namespace passo::test
