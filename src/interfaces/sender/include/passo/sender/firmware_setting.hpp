// The settings of a Grbl board: their descriptions, values, and files of them.
//
// grblHAL describes its settings itself ($ES, $EG, $ESH). Those of the other firmwares are described by a table
// (grbl_meanings/), from Grbl's documentation. A setting without a description has a name and a value only.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/grbl_meanings/firmware_setting_table.hpp"
#include "passo/sender/grbl_machine.hpp"

namespace passo {

// "number", "integer", "flag" …
std::string_view name_of(FirmwareSetting::Kind kind);

// Returns whether a setting is a password by its name, as FluidNC's $Sta/Password.
bool names_password(std::string_view name);
// Returns the value of a setting for people and files: asterisks for a password.
std::string shown_value(const FirmwareSetting& setting, std::string_view value);

// What grblHAL says about its settings: the answers to $ES, $EG and $ESH.
class SettingDescriptions {
 public:
  // Processes a line of an answer. Ignores all others.
  void hear(std::string_view line);
  bool empty() const { return settings_.empty(); }
  // Fills in what is known about the setting. Returns false if nothing is.
  bool describe(FirmwareSetting& setting, std::string_view axes) const;

 private:
  void hear_setting(std::string_view fields);
  void hear_table(std::string_view line);

  std::map<std::string, FirmwareSetting, std::less<>> settings_;
  std::map<std::string, std::string, std::less<>> groups_;
};

// Returns why the board should not get this value, as a clause; nothing if it may.
Status<std::string> check_setting(const FirmwareSetting& setting, std::string_view value);
// Returns whether two values are the same within the digits that boards write.
bool is_same_value(std::string_view a, std::string_view b);

// "$110=500" of a file.
struct NamedSetting {
  std::string name;
  std::string value;
};

// A file of settings: $n=value, one a line, below what the board says of itself. `passo machine --from` reads it too.
// Passwords are not in it: the file has asterisks, which are not written back.
std::string settings_text(const GrblMachine& machine, std::span<const FirmwareSetting> settings);
// Reads such a file, or a board's answer to $$ saved by another program. The error names the line and what was
// expected. At most 2,000 settings.
Result<std::vector<NamedSetting>, std::string> parse_settings_text(std::string_view text);

struct SettingDifference {
  std::string name;
  std::string in_file;   // empty: the file does not have it
  std::string on_board;  // empty: the board does not have it
};
// Returns the settings that differ, those of the file first, in its order. Passwords, which are read as asterisks, are
// not compared.
std::vector<SettingDifference> differences(std::span<const NamedSetting> file, std::span<const FirmwareSetting> board);

}  // namespace passo
