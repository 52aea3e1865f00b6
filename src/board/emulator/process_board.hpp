// ProcessBoard: an emulated board whose chip runs in a separate process. It handles the serial link, the time, the step
// counts and the plant; derived classes define the meaning of the pins.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "passo/emulator/emulated_board.hpp"
#include "passo/emulator/emulator_process.hpp"
#include "passo/plant/ideal_plant.hpp"
#include "passo/wire/board_segment.hpp"

namespace passo {

class ProcessBoard : public EmulatedBoard {
 public:
  void receive(std::span<const std::uint8_t> bytes) final { chip_->send(bytes); }
  bool run(Seconds most) final {
    const double seconds = std::clamp(most.value(), 0.0, longest_silence);
    const std::uint64_t end = chip_->cycle() + static_cast<std::uint64_t>(seconds * clock_rate_);
    update_inputs();
    while (said_.empty() && chip_->cycle() < end) {
      const std::int64_t events = plant_->events_to_next_change();
      const auto rises = static_cast<std::uint32_t>(
          events == Plant::never ? 0 : std::min<std::int64_t>(events, std::numeric_limits<std::int32_t>::max()));
      run_until(next_stop(end), {.at_byte = true, .watched = stepping_, .rises = rises});
    }
    return !said_.empty();
  }
  std::span<const std::uint8_t> replies() final {
    taken_ = std::exchange(said_, {});
    return taken_;
  }
  Seconds elapsed() const final { return time_of(chip_->cycle()); }
  std::vector<std::int64_t> positions() const final { return positions_; }
  void connect(Plant& plant) override {
    plant_ = &plant;
    update_inputs();
  }

 protected:
  // `clock_rate`: clock frequency in Hz.
  ProcessBoard(double clock_rate, std::size_t motors) : clock_rate_(clock_rate), positions_(motors, 0) {}

  // Sets the emulated chip, and which pins output steps. The first answer shows that the process is running and the
  // firmware boots.
  void start(std::unique_ptr<EmulatorProcess> chip, std::uint32_t stepping) {
    chip_ = std::move(chip);
    stepping_ = stepping;
    run_until(1, {});
  }
  // `pin`: 0 if the board has no such output.
  void watch_output(OutputSwitch which, std::uint32_t pin) {
    outputs_.emplace_back(which, pin);
    switched_ |= pin;
  }
  EmulatorProcess& chip() { return *chip_; }
  const EmulatorProcess& chip() const { return *chip_; }
  Plant& plant() { return *plant_; }
  Seconds time_of(std::uint64_t cycle) const { return Seconds(static_cast<double>(cycle) / clock_rate_); }
  bool is_high(std::uint32_t pin) const { return (levels_ & pin) != 0; }
  std::int64_t position(std::size_t motor) const { return positions_[motor]; }
  void count(std::uint64_t cycle, std::size_t motor, bool down) {
    positions_[motor] += down ? -1 : 1;
    pulses_[motor] += down ? -1 : 1;
    if (on_step) on_step(cycle, motor, down);
  }

 private:
  // The longest time, in seconds, for which an endless run() waits for a silent board.
  static constexpr double longest_silence = 10;

  // Counts the steps in a change of the pins.
  virtual void count_steps(const PinChange& change, std::uint32_t before) = 0;
  // Returns the speed that the spindle's pins command, in rpm; negative: reverse.
  virtual double commanded_rpm() const = 0;
  // Sets the input pins after the plant's inputs have changed.
  virtual void set_pins(std::uint16_t inputs) = 0;
  // Returns the latest cycle at which the run to cycle `end` must be interrupted.
  virtual std::uint64_t next_stop(std::uint64_t end) { return end; }

  void run_until(std::uint64_t cycle, const EmulatorProcess::Stops& stops) {
    if (!chip_->run(cycle, stops)) throw std::runtime_error(chip_->error());
    for (const PinChange& change : chip_->changes()) {
      const std::uint32_t before = std::exchange(levels_, change.levels);
      if (((before ^ change.levels) & stepping_) != 0) follow(change, before);
      if (((before ^ change.levels) & switched_) != 0 && on_outputs) on_outputs(change.cycle, switched_outputs());
    }
    const double rpm = commanded_rpm();
    if (rpm != rpm_) plant_->command_spindle(elapsed(), rpm_ = rpm);
    update_inputs();
    said_.insert(said_.end(), chip_->said().begin(), chip_->said().end());
  }
  std::uint8_t switched_outputs() const {
    unsigned switches = 0;
    for (const auto& [which, pin] : outputs_) {
      if (is_high(pin)) switches |= which;
    }
    return static_cast<std::uint8_t>(switches);
  }
  void follow(const PinChange& change, std::uint32_t before) {
    pulses_ = {};
    count_steps(change, before);
    if (std::ranges::any_of(pulses_, [](std::int64_t pulses) { return pulses != 0; })) {
      plant_->pulse(time_of(change.cycle), pulses_);
    }
  }
  void update_inputs() {
    const std::uint16_t inputs = plant_->inputs_at(elapsed());
    if (inputs != std::exchange(inputs_, inputs)) set_pins(inputs);
  }

  double clock_rate_;
  std::unique_ptr<EmulatorProcess> chip_;
  std::uint32_t stepping_ = 0;  // the pins that output steps
  std::vector<std::pair<OutputSwitch, std::uint32_t>> outputs_;
  std::uint32_t switched_ = 0;  // their pins
  std::uint32_t levels_ = 0;
  IdealPlant own_plant_;
  Plant* plant_ = &own_plant_;
  std::uint16_t inputs_ = 0;  // the inputs last reported by the plant
  double rpm_ = 0;
  std::vector<std::int64_t> positions_;
  MotorSteps pulses_{};  // the pulses of the current change
  std::vector<std::uint8_t> said_;
  std::vector<std::uint8_t> taken_;
};

}  // namespace passo
