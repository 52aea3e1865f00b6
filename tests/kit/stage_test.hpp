// Tests feed a stage from a list, compare its text with a golden file, and draw from seeded randomness.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "kit/seed.hpp"
#include <gtest/gtest.h>

#include "passo/base/source.hpp"
#include "passo/geometry/axes.hpp"

namespace passo::test {

template <class T>
class ListSource final : public Source<T> {
 public:
  explicit ListSource(std::vector<T> items) : items_(std::move(items)) {}
  [[nodiscard]] bool next(T& item) override {
    if (at_ == items_.size()) return false;
    item = items_[at_++];
    return true;
  }

 private:
  std::vector<T> items_;
  std::size_t at_ = 0;
};

template <class T>
std::vector<T> drain(Source<T>& source) {
  std::vector<T> items;
  for (T item; source.next(item);) items.push_back(item);
  return items;
}

// `path` below the checkout. PASSO_UPDATE_GOLDEN=1 writes it.
inline void expect_golden(const std::string& path, const std::string& text) {
  const std::string full = std::string(PASSO_SOURCE_DIR "/") + path;
  if (std::getenv("PASSO_UPDATE_GOLDEN") != nullptr) {
    std::ofstream(full, std::ios::binary) << text;
    return;
  }
  std::ifstream file(full, std::ios::binary);
  ASSERT_TRUE(file) << full << " is missing; PASSO_UPDATE_GOLDEN=1 writes it";
  const std::string golden{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(text, golden) << full;
}

class Random {
 public:
  Random() : seed_(test::seed()), engine_(seed_) {}
  std::uint64_t seed() const { return seed_; }
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  bool chance(double share) { return between(0, 1) < share; }

 private:
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
