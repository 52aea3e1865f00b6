// The emulated Pico at the end of a serial line: EmulatedBoard for the kind "pico".
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "process_board.hpp"

#include "passo/chip/pico_pins.hpp"
#include "passo/emulator/emulated_board.hpp"
#include "passo/emulator/emulated_pico.hpp"

namespace passo {
namespace {

constexpr double clock_rate = 128e6;

struct Switch {
  std::uint16_t input = 0;
  std::uint8_t gpio = no_gpio;
};
using Switches = std::array<Switch, 7>;
constexpr Switches switches_of(const PicoPins& pins) {
  return {{{input_limit, pins.limits[0]},
           {input_limit << 1U, pins.limits[1]},
           {input_limit << 2U, pins.limits[2]},
           {input_probe, pins.probe},
           {input_emergency_stop, pins.emergency_stop},
           {input_hold, pins.feed_hold},
           {input_start, pins.cycle_start}}};
}

class PicoBoard final : public ProcessBoard {
 public:
  PicoBoard(std::unique_ptr<EmulatedPico> pico, const PicoPins& pins)
      : ProcessBoard(clock_rate, pins.motors), pins_(pins) {
    watch_output(spindle_reverse, gpio_bit(pins.spindle_direction));
    watch_output(mist_on, gpio_bit(pins.mist));
    watch_output(flood_on, gpio_bit(pins.flood));
    start(std::move(pico), std::uint32_t{pins.steps_of(0xff)} << pins.first);
  }
  void wire(const PinSetup& wiring) override {
    wiring_ = wiring;
    set_pins(plant().inputs_at(elapsed()));
  }

 private:
  // The spindle's turns in a short time are even.
  std::uint64_t next_stop(std::uint64_t end) override {
    const VirtualSpindle& spindle = plant().spindle();
    if (!pins_.has_encoder() || !spindle.has_encoder()) return end;
    constexpr std::uint64_t short_time = 25'600;
    const std::uint64_t until = std::min(end, chip().cycle() + short_time);
    const auto pulses_at = [&](std::uint64_t cycle) {
      return std::abs(spindle.turns_at(time_of(cycle))) * spindle.counts_per_turn();
    };
    chip().set_encoder({.from = pulses_at(chip().cycle()),
                        .to = pulses_at(until),
                        .pulses_per_turn = static_cast<std::uint32_t>(spindle.counts_per_turn())});
    return until;
  }
  double commanded_rpm() const override {
    const bool back = is_high(gpio_bit(pins_.spindle_direction)) != ((wiring_.outputs & spindle_reverse) != 0);
    const double duty = (wiring_.outputs & spindle_on) != 0 ? 1 - chip().duty() : chip().duty();
    return (back ? -1 : 1) * duty * full_rpm;
  }
  void count_steps(const PinChange& change, std::uint32_t before) override {
    const std::uint32_t turned = change.levels ^ before;
    for (std::size_t motor = 0; motor < pins_.motors; ++motor) {
      const std::uint32_t step = gpio_bit(pins_.motor[motor].step);
      const bool low_steps = (wiring_.steps >> motor & 1U) != 0;
      if ((turned & step) == 0 || is_high(step) == low_steps || !is_enabled()) continue;
      count(change.cycle, motor, is_high(gpio_bit(pins_.motor[motor].direction)));
    }
  }
  void set_pins(std::uint16_t inputs) override {
    std::uint32_t low = 0;
    for (const Switch& one : switches_) {
      if (((inputs ^ wiring_.inputs) & one.input) != 0) low |= gpio_bit(one.gpio);
    }
    chip().draw_low(low);
  }
  bool is_enabled() const {
    return pins_.enable == no_gpio || is_high(gpio_bit(pins_.enable)) == ((wiring_.outputs & inverted_enable) != 0);
  }

  const PicoPins& pins_;
  Switches switches_ = switches_of(pins_);
  PinSetup wiring_;  // how the plant is connected to the pins
};

}  // namespace

Result<std::unique_ptr<EmulatedBoard>, std::string> start_pico_board(std::string_view kind,
                                                                     const std::string& program) {
  const auto* const board = std::ranges::find(pico_boards, kind, &PicoBoardPins::name);
  if (board == std::end(pico_boards)) return Failure<std::string>{"there is no Pico named " + std::string(kind)};
  auto pico = EmulatedPico::start(program, board->pins);
  if (!pico) return Failure{pico.error()};
  return std::unique_ptr<EmulatedBoard>(std::make_unique<PicoBoard>(std::move(*pico), board->pins));
}

}  // namespace passo
