// follower_rates: the longest turn of each board's loop, from one sample of the clock lines to the next, while one, two
// or three motors step at once and apart, without and with frequent key presses. A level that lasts longer is always
// seen: that gives the highest rate. An even square wave may be faster, since a turn with a step and one without
// alternate. docs/follower.md has what it prints.
#include <algorithm>
#include <cstdio>
#include <functional>

#include "follower/avr_follower.hpp"
#include "follower/pic_run.hpp"

namespace passo {
namespace {

constexpr std::string_view counted_axes[] = {"x", "xy", "xyz"};

using Play = std::function<FollowerRun(const FollowerVector&, Turns)>;

struct Loop {
  const char* name = nullptr;
  double cycles_a_microsecond = 0;
  Play play;
  bool has_keypad = true;
  int slowness = 0;  // > 0: the board waits for a key, and all times are so many times as long
};

std::uint64_t longest_turn(const Loop& loop, std::string_view axes, bool busy) {
  std::uint64_t longest = 0;
  for (const Edges edges : {Edges::together, Edges::apart}) {
    for (const std::uint64_t seed : {1U, 2U}) {
      FollowerVector vector = random_steps(seed, 1'500, 18'000, edges, axes);
      if (busy) add_fidgeting(vector, seed);
      if (loop.slowness > 0) vector = after_automatic_key(vector, loop.slowness);
      longest = std::max(longest, loop.play(vector, Turns::watched).longest_turn);
    }
  }
  return longest;
}

// The shortest period, in ns, of which no pulse is lost; to a microsecond. For the boards that wait for a key.
Nanoseconds shortest_period(const Loop& loop, std::string_view axes) {
  Nanoseconds lost = 20'000;
  Nanoseconds followed = 250'000;
  while (followed - lost > 1'000) {
    const Nanoseconds middle = (lost + followed) / 2;
    const FollowerVector wave = after_automatic_key(square_wave(axes, 1'500, middle), 1);
    const bool follows = difference(wave, loop.play(wave, Turns::unwatched).changes, winding_outputs()).empty();
    (follows ? followed : lost) = middle;
  }
  return followed;
}

void print_rates(const Loop& loop) {
  for (const std::string_view axes : counted_axes) {
    for (const bool busy : {false, true}) {
      if (busy && !loop.has_keypad) continue;
      const std::uint64_t longest = longest_turn(loop, axes, busy);
      const double level = static_cast<double>(longest + 1) / loop.cycles_a_microsecond;
      std::printf("%-14s %zu  %-4s  longest turn %3llu cycles: each level %6.2f us, %5.1f kHz\n", loop.name,
                  axes.size(), busy ? "busy" : "idle", static_cast<unsigned long long>(longest), level, 500 / level);
    }
  }
}

}  // namespace
}  // namespace passo

int main() {
  using namespace passo;
  const AvrBoard uno = {"uno", "atmega328p", &uno_follower, PASSO_IMAGES "/follower_uno"};
  const AvrBoard mega = {"mega", "atmega2560", &mega_follower, PASSO_IMAGES "/follower_mega"};
  print_rates({"uno", 16, [&](const FollowerVector& vector, Turns) { return run_on_avr(uno, vector); }, false});
  print_rates({"mega", 16, [&](const FollowerVector& vector, Turns) { return run_on_avr(mega, vector); }});
  if (!gpsim_is_here()) return 0;
  const std::string images = PASSO_IMAGES;
  const std::string work = images + "/gpsim_rates";
  print_rates({"pic", 5, [&](const FollowerVector& vector, Turns turns) {
                 return run_on_pic(PicFollower::at_20_mhz, images, vector, work, turns);
               }});
  // At 4 MHz, where a cycle is five times as long. The listing is the first board's own program.
  const auto first = [&](const char* name, const std::string& image) {
    const Play play = [=](const FollowerVector& vector, Turns turns) {
      return run_image_on_pic(PicFollower::first_board, image, vector, work, turns);
    };
    return Loop{.name = name, .cycles_a_microsecond = 1, .play = play, .has_keypad = true, .slowness = 5};
  };
  const Loop loops[] = {first("first_board", images + "/first_board.cod"),
                        first("listing", PASSO_TEST_IMAGES "/first_board_listing.cod"),
                        first("listing, alone", PASSO_TEST_IMAGES "/first_board_loop.cod")};
  for (const Loop& loop : loops) print_rates(loop);
  std::printf("\nthe fastest square wave, one, two and three motors at one time, kHz\n");
  for (const Loop& loop : loops) {
    std::printf("%-14s", loop.name);
    for (const std::string_view axes : counted_axes) {
      std::printf("  %5.1f", 1e6 / static_cast<double>(shortest_period(loop, axes)));
    }
    std::printf("\n");
  }
}
