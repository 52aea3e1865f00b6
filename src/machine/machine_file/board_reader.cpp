#include "board_reader.hpp"

#include <cmath>

#include "pins_reader.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

constexpr NumberKey clock_key{"clock_hz", 1e3, 1e9, "16_000_000"};
constexpr NumberKey event_rate_key{"max_event_rate_hz", 10, 1e7, "50_000"};
constexpr NumberKey step_pulse_key{"step_pulse_us", 0.05, 1000, "2.5"};
constexpr NumberKey direction_setup_key{"direction_setup_us", 0, 15, "0.65"};
constexpr NumberKey direction_hold_key{"direction_hold_us", 0, 15, "0.65"};
constexpr NumberKey items_key{"held_items", 8, 240, "240"};

// Fewer ticks for an event are impossible: on any processor its interrupt takes longer.
constexpr double fewest_ticks_an_event = 16;
constexpr double longest_interval_ticks = 65535;

}  // namespace

std::optional<Hertz> read_board(TableReader& reader, BoardDescription& board) {
  const auto clock = reader.number(clock_key, Need::required);
  auto rate = reader.number(event_rate_key, Need::required);
  const auto pulse = reader.number(step_pulse_key, Need::optional);
  if (const auto time = reader.number(direction_setup_key, Need::optional))
    board.direction_setup = Seconds(*time * 1e-6);
  if (const auto time = reader.number(direction_hold_key, Need::optional)) board.direction_hold = Seconds(*time * 1e-6);
  if (const auto items = reader.whole_number(items_key, Need::optional)) board.held_items = static_cast<int>(*items);
  board.held_items_are_given = reader.has(items_key.name);
  read_windings(reader, board);

  if (clock && rate) {
    board.clock = Hertz(*clock);
    const double fastest = *clock / fewest_ticks_an_event;
    // Twice the slowest rate: every slower rate of steps then has a multiple between the two.
    const double slowest = 2 * *clock / longest_interval_ticks;
    if (*rate > fastest || *rate < slowest) {
      reader.error(
          "machine.event-rate", event_rate_key.name,
          fmt::format("a board with a clock of {} Hz cannot make {} events/s", *clock, *rate),
          fmt::format("{} from {:.0f} to {:.0f}: an event takes at least {} clock ticks, and an interval has 16 bits",
                      event_rate_key.name, std::ceil(slowest), fastest, fewest_ticks_an_event));
      rate.reset();
    }
  }
  if (!rate) return {};
  board.highest_event_rate = Hertz(*rate);
  if (pulse) board.step_pulse = Seconds(*pulse * 1e-6);
  // A driver wants a pause as long as the pulse.
  const double longest_us = 1e6 / (2 * *rate);
  if ((pulse || !reader.has(step_pulse_key.name)) && board.step_pulse.value() * 1e6 > longest_us * (1 + 1e-9)) {
    reader.error(
        "machine.step-pulse", step_pulse_key.name,
        fmt::format("a step pulse of {:g} us and a pause of the same length do not fit into an event at {:g} events/s",
                    board.step_pulse.value() * 1e6, *rate),
        fmt::format("{} = {:g} or less, or a lower {}", step_pulse_key.name, longest_us, event_rate_key.name));
  }
  return board.highest_event_rate;
}

}  // namespace passo
