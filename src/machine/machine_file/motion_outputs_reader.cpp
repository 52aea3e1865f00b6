#include "motion_outputs_reader.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include <fmt/format.h>

namespace passo {
namespace {

const char* const output_code = "machine.output";
constexpr std::string_view pin_key = "pin";
constexpr std::array<std::string_view, 3> pin_words{"flood", "mist", "spindle_direction"};  // in the order of Pin
constexpr std::array<std::string_view, most_digital_outputs_of_board> numbers{"0", "1", "2"};
constexpr NumberKey maximum_s_key{"maximum_s", 1, 1e6, "1000"};
constexpr NumberKey minimum_key{"minimum_percent", 0, 100, "5"};

std::optional<DigitalOutputDescription> read_output(TableReader& reader) {
  DigitalOutputDescription output;
  output.stays_on = reader.is_second_of(output_code, "on_stop", "off", "keep", Need::optional).value_or(false);
  const auto word = reader.text(pin_key, "flood", Need::required);
  if (!word) return {};
  const auto* const found = std::ranges::find(pin_words, *word);
  if (found == pin_words.end()) {
    reader.error(output_code, pin_key, fmt::format("{} = \"{}\"", reader.full_name(pin_key), word->substr(0, 40)),
                 "\"flood\", \"mist\" or \"spindle_direction\", an output of the board");
    return {};
  }
  output.pin = static_cast<DigitalOutputDescription::Pin>(found - pin_words.begin());
  return output;
}

using DigitalOutputs = std::array<std::optional<DigitalOutputDescription>, most_digital_outputs_of_board>;

DigitalOutputs read_digital_outputs(const TomlEntry& entry, const TomlReporter& reporter,
                                    const std::function<void(TableReader&)>& end) {
  DigitalOutputs outputs;
  for (const TomlEntry& table : std::get<TomlTable>(entry.value.content).entries) {
    const auto* const number = std::ranges::find(numbers, table.key);
    const auto* const content = std::get_if<TomlTable>(&table.value.content);
    if (number == numbers.end() || content == nullptr) {
      reporter.error(output_code, table.place, fmt::format("output.{} is no output", table.key.substr(0, 40)),
                     fmt::format("tables [output.0] to [output.{}]: the P of M62 to M65", numbers.back()));
      continue;
    }
    TableReader reader(*content, fmt::format("output.{}", table.key), table.place, reporter);
    const auto output = read_output(reader);
    end(reader);
    const auto is_same = [&](const auto& other) { return other && output && other->pin == output->pin; };
    if (std::ranges::any_of(outputs, is_same)) {
      reader.error(output_code, pin_key, fmt::format("{} is the pin of another output", reader.full_name(pin_key)),
                   "a pin for each output");
    }
    outputs[static_cast<std::size_t>(number - numbers.begin())] = output;
  }
  return outputs;
}

LaserDescription read_laser(const TomlEntry& entry, const TomlReporter& reporter,
                            const std::function<void(TableReader&)>& end) {
  TableReader reader(std::get<TomlTable>(entry.value.content), "laser", entry.place, reporter);
  LaserDescription laser;
  laser.maximum_s = reader.number(maximum_s_key, Need::required).value_or(laser.maximum_s);
  if (const auto percent = reader.number(minimum_key, Need::optional)) laser.minimum = *percent / 100;
  end(reader);
  return laser;
}

}  // namespace

MotionOutputsDescription read_motion_outputs(TableReader& top, const TomlReporter& reporter,
                                             const std::function<void(TableReader&)>& end) {
  MotionOutputsDescription outputs;
  if (const TomlEntry* output = top.table("output", "a table [output.0]", Need::optional)) {
    outputs.digital = read_digital_outputs(*output, reporter, end);
  }
  if (const TomlEntry* laser = top.table("laser", "a table [laser]", Need::optional)) {
    outputs.laser = read_laser(*laser, reporter, end);
  }
  return outputs;
}

}  // namespace passo
