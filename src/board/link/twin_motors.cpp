#include "passo/link/twin_motors.hpp"

#include <cassert>

namespace passo {

void TwinMotors::set(const std::vector<MotorPair>& pairs) {
  twins_.clear();
  for (const MotorPair& pair : pairs) twins_.push_back({.pair = pair});
}

TwinMotors::Turns TwinMotors::turns_with(const MotorPair& pair, std::uint8_t limits) {
  const bool first = (limits & pair.first_switch) != 0;
  const bool second = (limits & pair.second_switch) != 0;
  return first == second ? Turns::both : first ? Turns::first : Turns::second;
}

std::int32_t TwinMotors::count_of(const Twin& twin, const std::int32_t* counts) {
  if (twin.counts != Turns::second) return counts[twin.pair.first];
  return twin.pair.opposite ? -counts[twin.pair.second] : counts[twin.pair.second];
}

void TwinMotors::watch(std::uint8_t limits) {
  for (Twin& twin : twins_) twin.turns = turns_with(twin.pair, limits);
}

void TwinMotors::settle(const std::int32_t* counts) {
  for (Twin& twin : twins_) {
    const std::int32_t before = count_of(twin, counts);
    twin.counts = twin.turns;
    twin.shift += before - count_of(twin, counts);
  }
}

bool TwinMotors::forget_shifts(std::int32_t* counts) {
  bool any = false;
  for (Twin& twin : twins_) {
    any = any || twin.shift != 0;
    counts[twin.pair.first] -= twin.shift;
    twin.shift = 0;
  }
  return any;
}

BoardSegment TwinMotors::for_board(BoardSegment segment) const {
  assert(segment.bend == 0 || twins_.empty());
  for (const auto& [pair, turns, counts, shift] : twins_) {
    const unsigned first = 1U << pair.first;
    const unsigned second = 1U << pair.second;
    if (turns != Turns::first) {
      segment.increments[pair.second] = segment.increments[pair.first];
      if ((segment.flips & first) != 0) segment.flips = static_cast<std::uint8_t>(segment.flips | second);
      const bool down = ((segment.directions & first) != 0) != pair.opposite;
      if (down) segment.directions = static_cast<std::uint8_t>(segment.directions | second);
    }
    if (turns == Turns::second) {
      segment.increments[pair.first] = 0;
      segment.flips = static_cast<std::uint8_t>(segment.flips & ~first);
    }
  }
  return segment;
}

void TwinMotors::for_host(std::int32_t* counts) const {
  for (const Twin& twin : twins_) counts[twin.pair.first] = count_of(twin, counts) + twin.shift;
}

}  // namespace passo
