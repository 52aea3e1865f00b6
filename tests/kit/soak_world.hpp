// SoakWorld: a virtual machine at the end of a link, and the plant behind the machine. All three are disturbed: the
// link is cut or corrupts bytes; the door is opened, buttons are pressed, limit switches are closed, or the board is
// reset.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "kit/limit_watch.hpp"
#include "kit/line_trouble.hpp"
#include "kit/stage_test.hpp"

#include "passo/activity/machine_plant.hpp"
#include "passo/activity/stage_options.hpp"
#include "passo/machine/virtual_line.hpp"
#include "passo/machine/virtual_machine.hpp"

namespace passo::test {

class SoakWorld {
 public:
  SoakWorld(const MachineDescription& description, Random random, const Point& stands_at)
      : limits(description),
        machine(static_cast<std::uint8_t>(description.axes.size()), description.board.clock,
                description.board.highest_event_rate, static_cast<std::size_t>(description.board.held_items)),
        line(machine, description.board.clock, LineOptions()),
        description_(description),
        random_(std::move(random)),
        plant_(plant_of(description, stands_at, {plate()})) {
    machine.connect(plant_);
    machine.add_observer(limits);
    decoder_.set_motors(static_cast<std::uint8_t>(description.axes.size()));
    line.set_trouble([this](bool to_board, Bytes bytes) { return pass(to_board, std::move(bytes)); });
    next_ = now() + wait();
  }
  SoakWorld(const SoakWorld&) = delete;
  SoakWorld& operator=(const SoakWorld&) = delete;

  Seconds now() const { return machine.elapsed(); }
  Truth truth() { return plant_.truth_at(now()); }
  // Ends disturbances that are over, and begins a new one from time to time. Returns the description of the new one, or
  // null. With `homes`, limit switches are not pressed, because that would give the machine a wrong position.
  const char* act(bool homes) {
    for (std::size_t i = 0; i < due_.size();) {
      if (due_[i].at > now()) {
        ++i;
        continue;
      }
      const std::function<void()> happen = std::move(due_[i].happen);
      due_.erase(due_.begin() + static_cast<std::ptrdiff_t>(i));
      happen();
    }
    if (now() < next_) return nullptr;
    next_ = now() + wait();
    return trouble(homes);
  }
  // Simulates an operator who turns axes beyond their travel back by hand. Must be called at standstill.
  void turn_back() {
    MotorSteps steps{};
    for (std::size_t m = 0; m < description_.axes.size(); ++m) {
      const AxisDescription& axis = description_.axes[m];
      const double scale = axis.inverted ? -axis.steps_per_unit : axis.steps_per_unit;
      const double place = truth().positions[m] / scale;
      steps[m] = std::llround(std::clamp(place, axis.travel_low, axis.travel_high) * scale);
    }
    plant_.stand_at(steps);
    machine.set_switch(0, false);  // makes the machine evaluate the plant
  }
  // Returns whether a limit switch is pressed by hand, so that homing may find a wrong position.
  bool fools() const { return fools_; }

  LimitWatch limits;
  VirtualMachine machine;
  VirtualLine line;
  std::uint64_t cuts = 0;
  std::uint64_t spoiled = 0;  // number of corrupted bytes and frames
  std::uint64_t presses = 0;
  std::uint64_t doors = 0;
  std::uint64_t emergency_stops = 0;
  std::uint64_t limit_presses = 0;
  std::uint64_t resets = 0;
  std::uint64_t stops = 0;  // number of instant stops of the board

 private:
  struct Due {
    Seconds at{0};
    std::function<void()> happen;
  };

  // Returns a plate under the whole table for the probe to touch.
  static TouchBox plate() {
    TouchBox box;
    box.ranges[Axis::z].high = -25;
    return box;
  }
  Seconds wait() { return Seconds(std::exp(random_.between(-1, 4.2))); }
  void later(double from, double to, std::function<void()> happen) {
    due_.push_back(
        {.at = now() + Seconds(std::exp(random_.between(std::log(from), std::log(to)))), .happen = std::move(happen)});
  }
  void close(std::uint16_t which, double shortest, double longest) {
    machine.set_switch(which, true);
    later(shortest, longest, [this, which] { machine.set_switch(which, false); });
  }

  const char* trouble(bool homes) {
    const double kind = random_.between(0, 1);
    if (kind < 0.25) {
      ++presses;
      close(input_hold, 0.02, 0.5);
      return "--- hold is pressed";
    }
    if (kind < 0.55) {
      ++presses;
      close(input_start, 0.02, 0.5);
      return "--- start is pressed";
    }
    if (kind < 0.65) {
      ++doors;
      close(input_door, 0.05, 10);
      return "--- the door opens";
    }
    if (kind < 0.80) {
      ++cuts;
      line.cut(now() + Seconds(random_.between(0, 0.1)), Seconds(std::exp(random_.between(-5, 2.2))));
      return "--- the line is cut";
    }
    if (kind < 0.90) {
      spoil();
      return "--- the line spoils bytes";
    }
    if (kind < 0.94) {
      ++emergency_stops;
      close(input_emergency_stop, 0.05, 5);
      return "--- emergency stop";
    }
    if (kind < 0.97) {
      if (homes) return nullptr;
      ++limit_presses;
      fools_ = true;
      const auto which = static_cast<std::uint16_t>(input_limit << static_cast<unsigned>(random_.between(0, 2.999)));
      machine.set_switch(which, true);
      later(0.02, 0.5, [this, which] {
        machine.set_switch(which, false);
        fools_ = false;
      });
      return "--- a limit switch is pressed";
    }
    ++resets;
    machine.reset_board();
    limits.forget(machine.now());
    return "--- the board is reset";
  }

  void spoil() {
    if (spoiler_) return;
    spoiler_.emplace(static_cast<std::uint64_t>(random_.between(0, 1e15)));
    later(0.5, 10, [this] {
      spoiled += static_cast<std::uint64_t>(spoiler_->faults);
      spoiler_.reset();
    });
  }
  Bytes pass(bool to_board, Bytes bytes) {
    for (std::size_t i = 0; !to_board && i < bytes.size(); ++i) {
      if (decoder_.feed(bytes[i]) != Decoded::frame || decoder_.frame().type != MessageType::fault) continue;
      ++stops;
      limits.forget(machine.now());
    }
    return spoiler_ ? (*spoiler_)(to_board, bytes) : bytes;
  }

  const MachineDescription& description_;
  Random random_;
  IdealPlant plant_;
  std::vector<Due> due_;
  Seconds next_{0};
  bool fools_ = false;
  std::optional<RandomTrouble> spoiler_;
  Decoder decoder_;
};

}  // namespace passo::test
