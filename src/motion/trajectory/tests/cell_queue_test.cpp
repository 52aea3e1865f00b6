// The planner's queue: a ring that grows.
#include "../cell_queue.hpp"

#include <deque>

#include "kit/stage_test.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

// Compares with a deque, for random operations, at every size at which the queue grows.
TEST(CellQueue, keeps_its_cells_in_order) {
  test::Random random;
  for (const std::size_t capacity : {2U, 100U, 256U, 1000U}) {
    CellQueue queue(capacity, 3, 1);
    std::deque<double> expected;
    double number = 0;
    for (int i = 0; i < 20'000; ++i) {
      const bool filling = i / 3000 % 2 == 0;
      const double kind = random.between(0, 1);
      if (kind < 0.05 && expected.size() < capacity + 5) {
        queue.push_front().cell.start = ++number;
        expected.push_front(number);
      } else if (kind < (filling ? 0.7 : 0.4) && !queue.full()) {
        const CellPlace place = queue.push();
        place.cell.start = ++number;
        place.cell.demand_count = 3;
        place.demands[2].limit = number;
        expected.push_back(number);
      } else if (!expected.empty()) {
        queue.pop();
        expected.pop_front();
      }
      ASSERT_EQ(queue.size(), expected.size());
      if (expected.empty()) continue;
      ASSERT_EQ(queue[0].cell.start, expected.front());
      ASSERT_EQ(queue.back().cell.start, expected.back());
      ASSERT_EQ(queue[expected.size() / 2].cell.start, expected[expected.size() / 2]);
    }
  }
}

}  // namespace
}  // namespace passo
