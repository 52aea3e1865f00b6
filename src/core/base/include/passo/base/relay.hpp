// Relay: passes items made by one thread to several readers, each in its own thread.
//
//   make ──▶ ring of blocks ──▶ reader 1
//                           └─▶ reader 2
//
// Each reader gets every item once, in order, so its results do not depend on thread timing. Memory is bounded: make()
// waits while the slowest reader is a whole ring behind. An item must not refer to anything that make() changes later.
//
// WebAssembly has no threads here: there run() calls each reader with each item.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>
#ifndef __wasi__
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#endif

namespace passo {

#ifdef __wasi__
template <class Item>
class Relay {
 public:
  using Make = std::function<bool(Item&)>;
  using Reader = std::function<void(const Item&)>;

  explicit Relay(std::vector<Reader> readers) : readers_(std::move(readers)) {}

  void run(const Make& make) {
    while (make(item_)) {
      for (const Reader& reader : readers_) reader(item_);
    }
  }

 private:
  const std::vector<Reader> readers_;
  Item item_;
};
#else
template <class Item>
class Relay {
 public:
  using Make = std::function<bool(Item&)>;
  using Reader = std::function<void(const Item&)>;

  explicit Relay(std::vector<Reader> readers) : readers_(std::move(readers)), read_(readers_.size()), ring_(blocks) {
    try {
      for (std::size_t i = 0; i < readers_.size(); ++i) threads_.emplace_back([this, i] { follow(i); });
    } catch (...) {  // the system cannot create more threads
      finish();
      throw;
    }
  }
  ~Relay() { finish(); }
  Relay(const Relay&) = delete;
  Relay& operator=(const Relay&) = delete;

  // Calls make() until it returns false, then waits for the readers. Rethrows a reader's exception.
  void run(const Make& make) {
    for (bool more = true; more;) {
      Block& block = free_block();
      for (block.count = 0; block.count < block_size && more;) {
        more = make(block.items[block.count]);
        if (more) ++block.count;
      }
      give();
    }
    finish();
    if (error_) std::rethrow_exception(error_);
  }

 private:
  static constexpr std::size_t block_size = 32;
  static constexpr std::size_t blocks = 8;
  struct Block {
    std::array<Item, block_size> items;
    std::size_t count = 0;
  };

  Block& free_block() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] {
      return std::ranges::all_of(read_, [this](std::uint64_t read) { return given_ - read < blocks; });
    });
    return ring_[given_ % blocks];
  }
  void give() {
    const std::lock_guard lock(mutex_);
    ++given_;
    changed_.notify_all();
  }
  void finish() {
    {
      const std::lock_guard lock(mutex_);
      over_ = true;
      changed_.notify_all();
    }
    for (std::thread& thread : threads_) thread.join();
    threads_.clear();
  }

  // A reader that throws gets no more items, and does not block the others.
  void follow(std::size_t reader) {
    bool reads = true;
    for (std::uint64_t at = 0; wait_for(at); ++at) {
      const Block& block = ring_[at % blocks];
      try {
        for (std::size_t i = 0; i < block.count && reads; ++i) readers_[reader](block.items[i]);
      } catch (...) {
        reads = false;
        const std::lock_guard lock(mutex_);
        if (!error_) error_ = std::current_exception();
      }
      const std::lock_guard lock(mutex_);
      read_[reader] = at + 1;
      changed_.notify_all();
    }
  }
  // Waits for a block. Returns false if there is no such block.
  bool wait_for(std::uint64_t number) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return number < given_ || over_; });
    return number < given_;
  }

  const std::vector<Reader> readers_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::uint64_t> read_;  // number of blocks that each reader has read
  std::uint64_t given_ = 0;          // number of blocks made
  bool over_ = false;
  std::exception_ptr error_;
  std::vector<Block> ring_;
  std::vector<std::thread> threads_;
};
#endif

}  // namespace passo
