// board_rates: sweeps event rates on the emulated boards and prints what the firmware makes of them, as the table in
// docs/boards.md. Numbers as arguments are intervals in ticks to try instead. With --pulses: the highest rates that the
// boards state for each length of step pulses, as the other table there.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <string_view>

#include "emulator/stated_timing.hpp"
#include "emulator/streamed_run.hpp"

namespace {

using namespace passo;

// `fastest`: in ticks; what is faster is left out.
void sweep(const BoardUnderTest& board, const char* name, bool changing, std::uint32_t fastest,
           const std::vector<std::uint32_t>& intervals) {
  for (const std::uint32_t interval : intervals) {
    if (interval < fastest) continue;
    BoardBench bench(board);
    std::mt19937_64 random(1);
    const auto motors = static_cast<std::uint8_t>(board.motors.size());
    StreamKind kind{.shortest_interval = interval,
                    .longest_interval = interval,
                    .shortest_segment = 200,
                    .longest_segment = 255,
                    .segments = 150,
                    .ramp = 20};
    if (changing) {
      kind.longest_interval += interval / 8;
      kind.shortest_segment = 120;
    }
    const std::vector<BoardSegment> stream = random_stream(random, motors, kind);
    const EdgeCheck check = bench.play(stream);
    const auto number = [](auto value) { return std::to_string(value); };
    const bool pulses = board.motors[0].step.exists();
    const std::string pulse = pulses ? number(check.shortest_pulse) : "";
    const std::string setup = pulses ? number(check.shortest_setup) : "";
    std::printf("| %s | %zu | %u | %.1f | %s | %s | %s | %s | %s | %s |\n", name, board.motors.size(),
                board.baud / 1000, 16000.0 / interval, check.exact() ? "yes" : "no", number(check.error).c_str(),
                number(check.apart).c_str(), pulse.c_str(), setup.c_str(), number(check.overruns).c_str());
    std::fflush(stdout);
  }
}

std::string stated_rate(const char* kind, const char* program, double pulse, double set_up) {
  constexpr double ticks_of_microsecond = 16;
  constexpr double clock = 16e6;
  if (program[0] == '\0') return "";
  const auto board = EmulatedBoard::start(kind, program);
  if (!board) throw std::runtime_error(board.error());
  const auto ticks = [](double time) { return static_cast<std::uint8_t>(std::ceil(time * ticks_of_microsecond)); };
  const auto timing = test::stated_timing(**board, {.pulse = ticks(pulse), .set_up = ticks(set_up)});
  if (!timing) throw std::runtime_error(std::string(kind) + " does not answer");
  return std::to_string(static_cast<long>(clock / timing->event_ticks));
}

void print_pulses() {
  constexpr double short_set_up = 0.65;
  constexpr double long_set_up = 5;
  std::puts("| step pulse, us | Uno | Uno, set-up 5 us | Mega | Mega, set-up 5 us | Pico |");
  std::puts("|---:|---:|---:|---:|---:|---:|");
  for (const double pulse : {1.0, 1.9, 2.5, 5.0, 10.0}) {
    std::printf("| %g |", pulse);
    for (const double set_up : {short_set_up, long_set_up}) {
      std::printf(" %s |", stated_rate("uno", PASSO_MOTION_UNO, pulse, set_up).c_str());
    }
    for (const double set_up : {short_set_up, long_set_up}) {
      std::printf(" %s |", stated_rate("mega", PASSO_MOTION_MEGA, pulse, set_up).c_str());
    }
    std::printf(" %s |\n", stated_rate("pico", PASSO_MOTION_PICO, pulse, short_set_up).c_str());
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::string_view(argv[1]) == "--pulses") {
    try {
      print_pulses();
    } catch (const std::exception& error) {
      std::fprintf(stderr, "board_rates: %s\n", error.what());
      return 1;
    }
    return 0;
  }
  std::vector<std::uint32_t> intervals;
  for (int i = 1; i < argc; ++i) intervals.push_back(static_cast<std::uint32_t>(std::strtoul(argv[i], nullptr, 10)));
  const bool all = intervals.empty();
  if (all) intervals = {300, 200, 178, 160, 145, 133, 120, 114, 107};
  const std::vector<std::uint32_t> slow = all ? std::vector<std::uint32_t>{1600, 800, 640, 533} : intervals;
  const std::vector<DriveMode> drives(4, DriveMode::half_step);
  try {
    std::puts(
        "| board | motors | kbaud | events/s, thousands | every edge | error, cycles | apart | pulse | set-up | "
        "bytes lost |");
    std::puts("|---|---:|---:|---:|---|---:|---:|---:|---:|---:|");
    for (const bool changing : {false, true}) {
      sweep(uno_under_test(PASSO_MOTION_UNO), changing ? "Uno, changing" : "Uno, even", changing, all ? 107 : 1,
            intervals);
    }
    for (const std::uint8_t motors : {std::uint8_t{4}, std::uint8_t{6}}) {
      const BoardUnderTest mega = mega_under_test(PASSO_MOTION_MEGA, motors);
      for (const bool changing : {false, true}) {
        sweep(mega, changing ? "Mega, changing" : "Mega, even", changing, motors > 4 ? 178 : 145, intervals);
      }
    }
    for (const bool changing : {false, true}) {
      sweep(uno_windings_under_test(PASSO_MOTION_UNO_HALF_STEP, drives),
            changing ? "Uno, windings, changing" : "Uno, windings, even", changing, 300, slow);
      sweep(mega_windings_under_test(PASSO_MOTION_MEGA_HALF_STEP, drives),
            changing ? "Mega, windings, changing" : "Mega, windings, even", changing, 300, slow);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "board_rates: %s\n", error.what());
    return 1;
  }
  return 0;
}
