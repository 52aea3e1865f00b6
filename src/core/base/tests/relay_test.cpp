#include "passo/base/relay.hpp"

#include <atomic>
#include <chrono>
#include <numeric>
#include <stdexcept>

namespace passo {
namespace {

constexpr int many = 10'000;

std::function<bool(int&)> up_to(int end) {
  return [next = 0, end](int& item) mutable { return (item = next++) < end; };
}

TEST(Relay, gives_every_reader_every_item_in_order) {
  for (const int count : {0, 1, 31, 32, 33, 255, 256, 257, many}) {
    std::vector<int> wanted(static_cast<std::size_t>(count));
    std::iota(wanted.begin(), wanted.end(), 0);
    std::vector<int> first;
    std::vector<int> second;
    Relay<int>({[&](int item) { first.push_back(item); }, [&](int item) { second.push_back(item); }}).run(up_to(count));
    EXPECT_EQ(first, wanted);
    EXPECT_EQ(second, wanted);
  }
}

TEST(Relay, runs_no_further_ahead_than_its_ring) {
  std::atomic<int> read = 0;
  int made = 0;
  int furthest = 0;
  Relay<int> relay({[&](int) {
    if (read % 100 == 0) std::this_thread::sleep_for(std::chrono::microseconds(100));
    ++read;
  }});
  relay.run([&](int&) {
    furthest = std::max(furthest, ++made - read);
    return made <= many;
  });
  EXPECT_EQ(read, many);
  EXPECT_LE(furthest, 256 + 1);
}

TEST(Relay, throws_what_a_reader_threw_after_the_others_have_read_all) {
  int read = 0;
  int before = 0;
  Relay<int> relay({[&](int item) {
                      if (item == 100) throw std::runtime_error("full");
                      ++before;
                    },
                    [&](int) { ++read; }});
  EXPECT_THROW(relay.run(up_to(many)), std::runtime_error);
  EXPECT_EQ(read, many);
  EXPECT_EQ(before, 100) << "a reader that threw gets nothing more";
}

TEST(Relay, ends_its_threads_where_the_maker_throws) {
  int read = 0;
  {
    Relay<int> relay({[&](int) { ++read; }});
    const auto fails = [made = 0](int&) mutable -> bool {
      return ++made < 1000 ? true : throw std::runtime_error("no more");
    };
    EXPECT_THROW(relay.run(fails), std::runtime_error);
  }
  EXPECT_LT(read, 1000);
}

}  // namespace
}  // namespace passo
