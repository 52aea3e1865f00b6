// FirmwareSetting: one setting of the firmware of a Grbl board ("$110=500.000"), with its name, unit, range and
// meaning; and the table of the settings of Grbl 1.1.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace passo {

struct FirmwareSetting {
  enum class Kind : std::uint8_t {
    unknown,
    number,
    integer,
    flag,    // 0 or 1
    bits,    // the sum of 1, 2, 4 …, one for each of `choices`
    axes,    // the same, one for each axis of the board
    choice,  // the position in `choices`, from 0
    text,
    password,  // the value is never shown: see shown_value()
  };
  std::string name;          // "$110"
  std::string value;         // as the board writes it
  std::string title = {};    // "Maximum rate of X"; empty: not described
  std::string unit = {};     // "mm/min"
  std::string group = {};    // "Axis X"
  std::string meaning = {};  // sentences
  Kind kind = Kind::unknown;
  std::vector<std::string> choices = {};  // empty text: not in use
  std::optional<double> least = {};
  std::optional<double> most = {};
  bool zero_too = false;       // 0 is allowed below `least`
  bool needs_restart = false;  // takes effect when the board has restarted
  bool read_only = false;      // cannot be written by its number
};

// Returns 110 of "$110"; nothing if it is no number.
std::optional<int> read_setting_number(std::string_view name);

// Fills in what the table says about a setting of Grbl 1.1. `axes`: the letters of the board's axes.
void describe_by_table(FirmwareSetting& setting, std::string_view axes);

}  // namespace passo
