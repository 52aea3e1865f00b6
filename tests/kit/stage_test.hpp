// Functions for tests of a stage: feeding the stage from a list, comparing its text with a golden file (golden.hpp),
// and seeded random numbers.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "kit/golden.hpp"
#include "kit/list_source.hpp"
#include "kit/seed.hpp"
#include <gtest/gtest.h>

#include "passo/geometry/axes.hpp"

namespace passo::test {

template <class T>
std::vector<T> drain(Source<T>& source) {
  std::vector<T> items;
  for (T item; source.next(item);) items.push_back(item);
  return items;
}

class Random {
 public:
  explicit Random(std::uint64_t more = 0) : seed_(test::seed() + more), engine_(seed_) {}
  // Returns a generator for one trial of many; prints nothing.
  static Random of(std::uint64_t seed) { return Random(std::mt19937_64(seed), seed); }

  std::uint64_t seed() const { return seed_; }
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  bool chance(double share) { return between(0, 1) < share; }

 private:
  Random(std::mt19937_64 engine, std::uint64_t seed) : seed_(seed), engine_(engine) {}

  std::uint64_t seed_ = 0;
  std::mt19937_64 engine_;
};

inline Point xyz(double x, double y, double z = 0) {
  Point point;
  point[Axis::x] = x;
  point[Axis::y] = y;
  point[Axis::z] = z;
  return point;
}

}  // namespace passo::test
