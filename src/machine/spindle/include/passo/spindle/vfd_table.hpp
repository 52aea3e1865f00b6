// VfdTable: the registers of a drive that speaks standard Modbus RTU, from a table file (TOML) or built in.
//
// docs/manual/spindle-modbus.md explains the keys of a table file.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

// A value in a register. `scale`: counts of the register for one unit.
struct VfdRegister {
  int function = 3;
  std::uint16_t address = 0;
  double scale = 1;
  bool is_in_hertz = false;     // of a speed; otherwise rpm
  std::uint16_t mask = 0xFFFF;  // of a fault: the bits of its number
};

struct VfdCommand {
  int function = 6;
  std::uint16_t address = 0;
  std::uint16_t value = 0;
};

struct VfdTable {
  std::string name;
  VfdRegister speed{.function = 6};
  VfdCommand forward;
  std::optional<VfdCommand> reverse = {};
  VfdCommand stop;
  std::optional<VfdCommand> reset = {};
  VfdRegister actual_speed;
  std::optional<VfdRegister> current = {};  // A
  std::optional<VfdRegister> load = {};     // percent of the rated load
  std::optional<VfdRegister> fault = {};    // 0: no fault
  std::map<int, std::string> fault_texts = {};
  // The setting by which the drive stops by itself when the computer falls silent. Empty: unknown.
  std::string timeout_setting = {};
};

// The H-100 of Changrong, which is also sold under other names.
const VfdTable& h100_table();

// `file` names the text in diagnostics. Empty: there was an error.
std::optional<VfdTable> parse_vfd_table(std::string_view text, const std::string& file, Diagnostics& diagnostics);
std::optional<VfdTable> load_vfd_table(const std::string& path, Diagnostics& diagnostics);

}  // namespace passo
