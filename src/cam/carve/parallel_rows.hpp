// for_each_row: processes independent rows in several threads. The assignment of rows to threads is random; the result
// does not depend on it.
#pragma once

#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace passo {

// Calls act(row, thread) for each row. `threads`: at least 1.
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
