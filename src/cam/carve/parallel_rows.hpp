// for_each_row: work on rows that do not depend on one another, by several threads. Which thread takes which row is
// chance; what a row becomes is not.
#pragma once

#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace passo {

// Calls act(row, thread) for each row. `threads`: 1 or more.
template <class Act>
void for_each_row(std::size_t rows, unsigned threads, const Act& act) {
  std::atomic<std::size_t> next{0};
  const auto work = [&](std::size_t thread) {
    for (std::size_t row = next++; row < rows; row = next++) act(row, thread);
  };
  std::vector<std::thread> others;
  for (std::size_t thread = 1; thread < threads && thread < rows; ++thread) others.emplace_back(work, thread);
  work(0);
  for (std::thread& other : others) other.join();
}

}  // namespace passo
