// The emulated Uno and Mega at the end of a serial line: EmulatedBoard for their kinds. The chip is in
// passo-emulate-avr, a program of its own (src/board/emulator/avr).
#include <array>
#include <bit>
#include <iterator>
#include <map>
#include <stdexcept>
#include <utility>

#include "process_board.hpp"
#include <fmt/format.h>

#include "passo/chip/mega_ramps.hpp"
#include "passo/chip/mega_windings.hpp"
#include "passo/chip/uno_cnc_shield.hpp"
#include "passo/chip/uno_windings.hpp"
#include "passo/emulator/emulated_avr.hpp"
#include "passo/emulator/emulated_board.hpp"
#include "passo/emulator/emulated_pico.hpp"

namespace passo {
namespace {

constexpr double clock_rate = 16e6;

struct Kind {
  const char* mcu;
  std::vector<MotorPins> motors;
  std::map<BoardInput, Pin> switches;
  Pin spindle_direction = {};
  Pin mist = {};
  Pin flood = {};
  bool has_encoder = false;
};

template <class Map>
Kind kind_of(bool is_mega, const Map& pins, DriveMode drive = {}) {
  Kind kind{.mcu = is_mega ? "atmega2560" : "atmega328p",
            .motors = {std::begin(pins.motor), std::end(pins.motor)},
            .switches = {{input_limit, pins.limits[0]},
                         {static_cast<BoardInput>(input_limit << 1U), pins.limits[1]},
                         {static_cast<BoardInput>(input_limit << 2U), pins.limits[2]},
                         {static_cast<BoardInput>(input_limit << 3U), pins.limits[3]},
                         {static_cast<BoardInput>(input_limit << 4U), pins.limits[4]},
                         {static_cast<BoardInput>(input_limit << 5U), pins.limits[5]},
                         {input_probe, pins.probe},
                         {input_emergency_stop, pins.emergency_stop},
                         {input_hold, pins.feed_hold},
                         {input_start, pins.cycle_start}},
            .spindle_direction = pins.spindle_direction,
            .mist = pins.mist,
            .flood = pins.flood,
            .has_encoder = pins.encoder.exists()};
  for (MotorPins& motor : kind.motors) motor.drive = drive;
  return kind;
}

Kind kind_named(std::string_view name) {
  const bool is_mega = name.starts_with("mega");
  for (const auto& [ending, drive] : {std::pair{"_two_on", DriveMode::two_on}, std::pair{"_wave", DriveMode::wave},
                                      std::pair{"_half_step", DriveMode::half_step}}) {
    if (!name.ends_with(ending)) continue;
    return is_mega ? kind_of(is_mega, mega_windings, drive) : kind_of(is_mega, uno_windings, drive);
  }
  return is_mega ? kind_of(is_mega, mega_ramps) : kind_of(is_mega, uno_cnc_shield);
}

struct Motor {
  std::uint32_t step = 0;
  std::uint32_t direction = 0;
  std::uint32_t enable = 0;  // 0: no such pin, always enabled
  std::array<std::uint32_t, winding_count> windings = {};
  DriveMode drive = DriveMode::two_on;
};

class AvrBoard final : public ProcessBoard {
 public:
  AvrBoard(const Kind& kind, std::string emulator, std::string program)
      : ProcessBoard(clock_rate, kind.motors.size()), has_encoder_(kind.has_encoder) {
    PinNumbers numbers;
    for (const MotorPins& pins : kind.motors) {
      Motor motor{.step = numbers.bit_of(pins.step),
                  .direction = numbers.bit_of(pins.direction),
                  .enable = numbers.bit_of(pins.enable),
                  .drive = pins.drive};
      for (std::size_t f = 0; f < winding_count; ++f) {
        motor.windings[f] = numbers.bit_of(pins.windings[f]);
        windings_ |= motor.windings[f];
      }
      steps_ |= motor.step;
      motors_.push_back(motor);
    }
    spindle_turns_back_ = numbers.bit_of(kind.spindle_direction);
    watch_output(spindle_reverse, spindle_turns_back_);
    if (windings_ == 0) {  // otherwise there are more pins than the emulator watches
      watch_output(mist_on, numbers.bit_of(kind.mist));
      watch_output(flood_on, numbers.bit_of(kind.flood));
    }
    for (const auto& [which, pin] : kind.switches) switches_.emplace_back(which, numbers.bit_of(pin));
    words_ = {std::move(emulator), kind.mcu, std::move(program), numbers.text()};
    start_emulator();
  }

  void connect(Plant& plant) override {
    if (has_encoder_ && plant.spindle().has_encoder()) start_with_encoder(plant.spindle().model());
    ProcessBoard::connect(plant);
  }
  void wire(const PinSetup& wiring) override {
    wiring_ = wiring;
    set_pins(plant().inputs_at(elapsed()));
  }

 private:
  void start_emulator() {
    start(std::make_unique<EmulatorProcess>(words_, fmt::format("{} has ended; check that {} is firmware for the {}",
                                                                words_[0], words_[2], words_[1])),
          steps_ | windings_);
  }
  // The emulator works out the same spindle as the plant: the commands come from the chip.
  void start_with_encoder(const SpindleModel& model) {
    words_.push_back(fmt::format("encoder={},{},{},{},{},{}", model.counts_per_turn, model.run_up, model.droop,
                                 model.ripple, model.ripple_rate, std::countr_zero(spindle_turns_back_)));
    start_emulator();
  }

  double commanded_rpm() const override {
    const bool back = is_high(spindle_turns_back_) != ((wiring_.outputs & spindle_reverse) != 0);
    const bool low_is_on = (wiring_.outputs & spindle_on) != 0;
    const double duty = low_is_on ? 1 - chip().duty() : chip().duty();
    return (back ? -1 : 1) * duty * full_rpm;
  }
  void count_steps(const PinChange& change, std::uint32_t before) override {
    const std::uint32_t turned = change.levels ^ before;
    for (std::size_t motor = 0; motor < motors_.size(); ++motor) {
      const Motor& pins = motors_[motor];
      const bool low_steps = (wiring_.steps >> motor & 1U) != 0;
      const bool steps = (turned & pins.step) != 0 && is_high(pins.step) != low_steps;
      if (steps && is_enabled(pins)) count(change.cycle, motor, is_high(pins.direction));
      if (windings_ != 0) follow_windings(change, motor);
    }
  }
  void set_pins(std::uint16_t inputs) override {
    std::uint32_t low = 0;
    for (const auto& [which, pin] : switches_) {
      if (((inputs ^ wiring_.inputs) & which) != 0) low |= pin;
    }
    chip().draw_low(low);
  }
  bool is_enabled(const Motor& pins) const {
    return pins.enable == 0 || is_high(pins.enable) == ((wiring_.outputs & inverted_enable) != 0);
  }
  // If a motor's windings are on two ports, there is a moment between the two writes. The pattern of that moment is in
  // no table.
  void follow_windings(const PinChange& change, std::size_t motor) {
    const WindingTable table = winding_table(motors_[motor].drive);
    unsigned pattern = 0;
    for (unsigned f = 0; f < winding_count; ++f) {
      if ((change.levels & motors_[motor].windings[f]) != 0) pattern |= 1U << f;
    }
    const auto place = static_cast<std::uint8_t>(position(motor));
    if (pattern == table.at(static_cast<std::uint8_t>(place + 1))) return count(change.cycle, motor, false);
    if (pattern == table.at(static_cast<std::uint8_t>(place - 1))) count(change.cycle, motor, true);
  }

  bool has_encoder_;
  std::vector<Motor> motors_;
  std::uint32_t steps_ = 0;
  std::uint32_t windings_ = 0;
  std::uint32_t spindle_turns_back_ = 0;
  std::vector<std::pair<BoardInput, std::uint32_t>> switches_;
  std::vector<std::string> words_;
  PinSetup wiring_;  // how the plant is connected to the pins
};

}  // namespace

Result<std::unique_ptr<EmulatedBoard>, std::string> EmulatedBoard::start(std::string_view kind,
                                                                         const std::string& program) {
  if (is_pico(kind)) return start_pico_board(kind, program);
  auto emulator = avr_emulator();
  if (!emulator) return Failure{emulator.error()};
  try {
    return std::unique_ptr<EmulatedBoard>(std::make_unique<AvrBoard>(kind_named(kind), std::move(*emulator), program));
  } catch (const std::runtime_error& error) {
    return Failure<std::string>{error.what()};
  }
}

}  // namespace passo
