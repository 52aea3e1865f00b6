// The follower's image for an Uno or a Mega in passo-emulate-avr; and every follower by its name.
#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "passo/chip/follower_pins.hpp"
#include "passo/confinement/temporary_folder.hpp"
#include "passo/emulator/emulated_avr.hpp"
#include "passo/emulator/emulated_follower.hpp"
#include "passo/emulator/emulator_process.hpp"

namespace passo {
namespace {

// The chip runs at 16 MHz.
constexpr std::uint64_t cycles_of(Nanoseconds time) {
  return static_cast<std::uint64_t>(time) * 2 / 125;
}
constexpr Nanoseconds time_of(std::uint64_t cycles) {
  return static_cast<Nanoseconds>(cycles * 125 / 2);
}

class AvrFollower {
 public:
  AvrFollower(const FollowerPins& pins, std::vector<std::string> words) : words_(std::move(words)) {
    for (std::uint8_t axis = 0; axis < follower_axes; ++axis) {
      const std::string name(1, "xyz"[axis]);
      std::vector<std::uint32_t> bits;
      for (const Pin pin : pins.windings[axis]) bits.push_back(numbers_.bit_of(pin));
      outputs_.emplace_back("windings." + name, bits);
      lines_["clock." + name] = numbers_.bit_of({pins.lines, axis});
      lines_["direction." + name] = numbers_.bit_of({pins.lines, static_cast<std::uint8_t>(3 + axis)});
    }
    lines_["relay"] = numbers_.bit_of(pins.relay_line);
    for (const auto& [line, bit] : lines_) low_ |= bit;
    for (const auto& [name, pin] : {std::pair{"relay", pins.relay}, std::pair{"indicator.relay", pins.relay_indicator},
                                    std::pair{"indicator.automatic", pins.automatic_indicator},
                                    std::pair{"indicator.manual", pins.manual_indicator}}) {
      if (pin.exists()) outputs_.emplace_back(name, std::vector{numbers_.bit_of(pin)});
    }
    button_ = numbers_.bit_of(pins.tool_button);
    for (std::size_t row = 0; row < keypad_rows; ++row) rows_[row] = numbers_.bit_of(pins.rows[row]);
    for (std::size_t column = 0; column < keypad_columns; ++column) {
      columns_[column] = numbers_.bit_of_drawn_low(pins.columns[column]);
      all_columns_ |= columns_[column];
    }
    words_.push_back(numbers_.text());
  }

  Result<FollowerRun, std::string> run(std::span<const LineChange> lines, Nanoseconds end) {
    chip_ = start();
    auto next = lines.begin();
    while (now() < end) {
      bool reset = false;
      for (; next != lines.end() && next->at <= now(); ++next) reset = reset || set(*next);
      if (reset) begin_again();
      const Nanoseconds until = next == lines.end() ? end : std::min(end, next->at);
      // A key connects its row to the column, so the row has to follow.
      chip_->draw_low(low_ | drawn_by_keys());
      if (!chip_->run(cycles_of(until - begun_) + 1, {.watched = all_columns_, .rises = all_columns_ != 0 ? 1U : 0U})) {
        return Failure{chip_->error()};
      }
      for (const PinChange& change : chip_->changes()) note(begun_ + time_of(change.cycle), change.levels);
    }
    return std::move(run_);
  }

 private:
  std::unique_ptr<EmulatorProcess> start() const {
    return std::make_unique<EmulatorProcess>(
        words_, fmt::format("{} has ended; check that {} is follower firmware", words_[0], words_[2]));
  }
  Nanoseconds now() const { return begun_ + time_of(chip_->cycle()); }
  // All pins float, and the program begins at its beginning.
  void begin_again() {
    begun_ = now();
    note(begun_, 0);
    chip_ = start();
  }

  // True: this was the emergency button.
  bool set(const LineChange& change) {
    if (change.line == "reset") return true;
    const KeyPlace place = key_place(change.line);
    if (place.row >= 0) {
      closed_[static_cast<std::size_t>(place.row)][static_cast<std::size_t>(place.column)] = change.high;
      return false;
    }
    const bool is_button = change.line == "button";
    const std::uint32_t bit = is_button ? button_ : lines_[change.line];
    low_ = change.high == is_button ? low_ | bit : low_ & ~bit;
    return false;
  }
  std::uint32_t drawn_by_keys() const {
    std::uint32_t drawn = 0;
    for (std::size_t row = 0; row < keypad_rows; ++row) {
      for (std::size_t column = 0; column < keypad_columns; ++column) {
        if (closed_[row][column] && (levels_ & columns_[column]) != 0) drawn |= rows_[row];
      }
    }
    return drawn;
  }

  void note(Nanoseconds at, std::uint32_t levels) {
    for (const auto& [output, bits] : outputs_) {
      unsigned before = 0;
      unsigned now = 0;
      for (std::size_t i = 0; i < bits.size(); ++i) {
        if ((levels_ & bits[i]) != 0) before |= 1U << i;
        if ((levels & bits[i]) != 0) now |= 1U << i;
      }
      if (before == now) continue;
      run_.changes.push_back({at, output, bits.size() == 4 ? winding_text(now) : std::to_string(now)});
    }
    levels_ = levels;
  }

  PinNumbers numbers_;
  std::vector<std::string> words_;
  std::vector<std::pair<std::string, std::vector<std::uint32_t>>> outputs_;
  std::map<std::string, std::uint32_t> lines_;
  std::uint32_t button_ = 0;
  std::array<std::uint32_t, keypad_rows> rows_ = {};
  std::array<std::uint32_t, keypad_columns> columns_ = {};
  std::uint32_t all_columns_ = 0;
  std::unique_ptr<EmulatorProcess> chip_;
  Nanoseconds begun_ = 0;  // the last reset
  std::uint32_t low_ = 0;  // what the lines and the button draw low
  std::uint32_t levels_ = 0;
  bool closed_[keypad_rows][keypad_columns] = {};
  FollowerRun run_;
};

Result<FollowerRun, std::string> run_avr_follower(bool is_mega, const std::string& image,
                                                  std::span<const LineChange> lines, Nanoseconds end) {
  auto emulator = avr_emulator();
  if (!emulator) return Failure{emulator.error()};
  const FollowerPins& pins = is_mega ? mega_follower : uno_follower;
  return AvrFollower(pins, {std::move(*emulator), is_mega ? "atmega2560" : "atmega328p", image}).run(lines, end);
}

bool is_first_board(std::string_view follower) {
  return follower.starts_with("first_board");
}

}  // namespace

std::vector<std::string> emulated_followers() {
  std::vector<std::string> names = {"first_board", "first_board_copied", "first_board_as_listed"};
  for (const char* board : {"pic", "uno", "mega"}) {
    for (const char* drive : {"two_on", "wave", "half_step"}) names.push_back(fmt::format("{}_{}", board, drive));
  }
  return names;
}

std::filesystem::path follower_image(std::string_view follower) {
  if (is_first_board(follower)) return fmt::format("{}.cod", follower);
  return fmt::format("follower_{}.{}", follower, follower.starts_with("pic") ? "cod" : "elf");
}

bool has_keypad(std::string_view follower) {
  return !follower.starts_with("uno");
}

std::vector<std::string> outputs_of_follower(std::string_view follower) {
  std::vector<std::string> outputs = {"windings.x", "windings.y", "windings.z", "relay"};
  if (!has_keypad(follower)) return outputs;  // no pins are left for indicators, too
  outputs.emplace_back("indicator.relay");
  if (is_first_board(follower)) {
    for (const char* led : {"led.0", "led.1", "led.2", "led.3"}) outputs.emplace_back(led);
  } else {
    for (const char* mode : {"indicator.automatic", "indicator.manual"}) outputs.emplace_back(mode);
  }
  return outputs;
}

Result<FollowerRun, std::string> run_follower(std::string_view follower, const std::filesystem::path& image,
                                              std::span<const LineChange> lines, Nanoseconds end) {
  if (!std::filesystem::exists(image)) return Failure{"no such image: " + image.string()};
  if (follower.starts_with("uno") || follower.starts_with("mega")) {
    return run_avr_follower(follower.starts_with("mega"), image, lines, end);
  }
  TemporaryFolder work;
  if (!work.make()) return Failure{std::string("there is no folder for the emulator's files")};
  const auto board = is_first_board(follower) ? PicFollower::first_board : PicFollower::at_20_mhz;
  return run_pic_follower(board, image, lines, end, work.name());
}

}  // namespace passo
