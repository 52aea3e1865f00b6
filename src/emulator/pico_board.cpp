// The emulated Pico at the end of a serial line: EmulatedBoard for the kind "pico".
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "passo/chip/pico_pins.hpp"
#include "passo/emulator/emulated_board.hpp"
#include "passo/emulator/emulated_pico.hpp"
#include "passo/plant/ideal_plant.hpp"

namespace passo {
namespace {

constexpr double clock_rate = 128e6;
// How long, in seconds, an endless run() waits for a silent board.
constexpr double longest_silence = 10;

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

class PicoBoard final : public EmulatedBoard {
 public:
  PicoBoard(std::unique_ptr<EmulatedPico> pico, const PicoPins& pins)
      : pico_(std::move(pico)), pins_(pins), positions_(pins.motors, 0) {}

  void receive(std::span<const std::uint8_t> bytes) override { pico_->send(bytes); }

  bool run(Seconds most) override {
    const double seconds = std::clamp(most.value(), 0.0, longest_silence);
    const std::uint64_t end = pico_->cycle() + static_cast<std::uint64_t>(seconds * clock_rate);
    look_at_plant(elapsed());
    do {
      const std::uint64_t until = turn_encoder(end);
      const std::int64_t events = plant_->events_to_next_change();
      const auto rises = static_cast<std::uint32_t>(
          events == Plant::never ? 0 : std::min<std::int64_t>(events, std::numeric_limits<std::int32_t>::max()));
      if (!pico_->run(until, {.at_byte = said_.empty(), .watched = step_pins_, .rises = rises})) {
        throw std::runtime_error(pico_->error());
      }
      follow();
      said_.insert(said_.end(), pico_->said().begin(), pico_->said().end());
    } while (said_.empty() && pico_->cycle() < end);
    return !said_.empty();
  }

  std::span<const std::uint8_t> replies() override {
    taken_ = std::exchange(said_, {});
    return taken_;
  }

  Seconds elapsed() const override { return time_of(pico_->cycle()); }
  std::vector<std::int64_t> positions() const override { return positions_; }
  void connect(Plant& plant) override {
    plant_ = &plant;
    look_at_plant(elapsed());
  }

 private:
  // The spindle's turns in a short time are even.
  std::uint64_t turn_encoder(std::uint64_t end) {
    const VirtualSpindle& spindle = plant_->spindle();
    if (!pins_.has_encoder() || !spindle.has_encoder()) return end;
    constexpr std::uint64_t short_time = 25'600;
    const std::uint64_t until = std::min(end, pico_->cycle() + short_time);
    const auto pulses_at = [&](std::uint64_t cycle) {
      return std::abs(spindle.turns_at(time_of(cycle))) * spindle.counts_per_turn();
    };
    pico_->turn_encoder({.from = pulses_at(pico_->cycle()),
                         .to = pulses_at(until),
                         .pulses_per_turn = static_cast<std::uint32_t>(spindle.counts_per_turn())});
    return until;
  }
  static Seconds time_of(std::uint64_t cycle) { return Seconds(static_cast<double>(cycle) / clock_rate); }

  // Counts the steps of the last run, and looks how the spindle is commanded.
  void follow() {
    for (const PicoChange& change : pico_->changes()) {
      const std::uint32_t rose = change.levels & ~std::exchange(levels_, change.levels);
      if ((rose & step_pins_) == 0) continue;
      MotorSteps pulses{};
      for (std::size_t motor = 0; motor < pins_.motors; ++motor) {
        if ((rose & gpio_bit(pins_.motor[motor].step)) == 0) continue;
        const bool down = (change.levels & gpio_bit(pins_.motor[motor].direction)) != 0;
        pulses[motor] = down ? -1 : 1;
        positions_[motor] += pulses[motor];
        if (on_step) on_step(change.cycle, motor, down);
      }
      plant_->pulse(time_of(change.cycle), pulses);
    }
    const bool back = (levels_ & gpio_bit(pins_.spindle_direction)) != 0;
    const double rpm = (back ? -1 : 1) * pico_->duty() * full_rpm;
    if (rpm != rpm_) plant_->command_spindle(elapsed(), rpm_ = rpm);
    look_at_plant(elapsed());
  }
  void look_at_plant(Seconds time) {
    const std::uint16_t inputs = plant_->inputs_at(time);
    std::uint32_t low = 0;
    for (const Switch& one : switches_) {
      if ((inputs & one.input) != 0) low |= gpio_bit(one.gpio);
    }
    pico_->draw_low(low);
  }

  std::unique_ptr<EmulatedPico> pico_;
  const PicoPins& pins_;
  Switches switches_ = switches_of(pins_);
  std::uint32_t step_pins_ = std::uint32_t{pins_.steps_of(0xff)} << pins_.first;
  IdealPlant own_plant_;
  Plant* plant_ = &own_plant_;
  std::vector<std::int64_t> positions_;
  std::uint32_t levels_ = 0;
  double rpm_ = 0;
  std::vector<std::uint8_t> said_;
  std::vector<std::uint8_t> taken_;
};

}  // namespace

Result<std::unique_ptr<EmulatedBoard>, std::string> start_pico_board(std::string_view kind,
                                                                     const std::string& program) {
  const auto* const board = std::ranges::find(pico_boards, kind, &PicoBoardPins::name);
  if (board == std::end(pico_boards)) return Failure<std::string>{"no Pico is called " + std::string(kind)};
  auto pico = EmulatedPico::start(program, board->pins);
  if (!pico) return Failure{pico.error()};
  return std::unique_ptr<EmulatedBoard>(std::make_unique<PicoBoard>(std::move(*pico), board->pins));
}

}  // namespace passo
