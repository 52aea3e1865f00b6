// follower_rates: the longest turn of each board's loop, from one sample of the clock lines to the next, while three
// motors step at once and apart and a person plays with the keypad. A level that lasts longer is always seen: that
// gives the highest rate. docs/follower.md has what it prints.
#include <algorithm>
#include <cstdio>
#include <functional>

#include "follower/avr_follower.hpp"
#include "follower/pic_run.hpp"

namespace passo {
namespace {

using Play = std::function<FollowerRun(const FollowerVector&)>;

void print_rate(const char* board, double cycles_a_microsecond, const Play& play) {
  std::uint64_t longest = 0;
  for (const Edges edges : {Edges::together, Edges::apart}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      FollowerVector vector = random_steps(seed, 10'000, 17'000, edges);
      add_fidgeting(vector, seed);
      longest = std::max(longest, play(vector).longest_turn);
    }
  }
  const double level = static_cast<double>(longest + 1) / cycles_a_microsecond;
  std::printf("%-6s longest turn %3llu cycles: each level %5.2f us, %5.1f kHz\n", board,
              static_cast<unsigned long long>(longest), level, 500 / level);
}

}  // namespace
}  // namespace passo

int main() {
  using namespace passo;
  const AvrBoard uno = {"uno", "atmega328p", &uno_follower, PASSO_IMAGES "/follower_uno"};
  const AvrBoard mega = {"mega", "atmega2560", &mega_follower, PASSO_IMAGES "/follower_mega"};
  print_rate("uno", 16, [&](const FollowerVector& vector) { return run_on_avr(uno, vector); });
  print_rate("mega", 16, [&](const FollowerVector& vector) { return run_on_avr(mega, vector); });
  if (!gpsim_is_here()) return 0;
  const std::string images = PASSO_IMAGES;
  print_rate("pic", 5, [&](const FollowerVector& vector) {
    return run_on_pic(PicFollower::at_20_mhz, images, vector, images + "/gpsim_rates", Turns::watched);
  });
  print_rate("first", 1, [&](const FollowerVector& vector) {
    const FollowerVector later = after_automatic_key(vector, 5);
    return run_on_pic(PicFollower::first_board, images, later, images + "/gpsim_rates", Turns::watched);
  });
}
