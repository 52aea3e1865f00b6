#include "passo/sender/grbl_machine.hpp"

#include <cmath>
#include <utility>

#include "passo/sender/grbl_reply.hpp"

namespace passo {
namespace {

constexpr std::string_view name_of_fluidnc = "FluidNC";

bool is_system(std::string_view name) {
  return name.size() >= 3 && name.starts_with("G5") && name[2] >= '4' && name[2] <= '9';
}

}  // namespace

bool is_grbl_greeting(std::string_view line) {
  return line.starts_with("Grbl ") || line.starts_with("GrblHAL ") || line.ends_with("for help]");
}

void GrblMachine::hear_greeting(std::string_view line) {
  if (line.starts_with("GrblHAL")) firmware = "grblHAL";
  if (line.find(name_of_fluidnc) != std::string_view::npos) firmware = name_of_fluidnc;
}

void GrblMachine::hear(std::string_view line) {
  if (line.starts_with('$')) return hear_setting(line);
  if (!line.starts_with('[') || !line.ends_with(']')) return;
  line = line.substr(1, line.size() - 2);
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos) return;
  const std::string_view name = line.substr(0, colon);
  const std::string_view value = line.substr(colon + 1);
  if (name == "VER") {
    version = value.substr(0, value.find(':'));
    version.erase(version.find_last_not_of(' ') + 1);
    hear_greeting(version);
  } else if (name == "FIRMWARE") {
    firmware = value;
    // Its ring holds a byte less than it has told.
    if (firmware == "grblHAL") --bytes;
  } else if (name == "OPT") {
    hear_options(value);
  } else if (name == "AXS") {
    const std::size_t letters = value.find(':');
    if (letters != std::string_view::npos && letters + 1 < value.size()) axes = value.substr(letters + 1);
  } else if (name == "GC") {
    hear_modes(value);
  } else if (is_system(name) || name == "G28" || name == "G30" || name == "G92" || name == "TLO") {
    hear_offset(name, value);
  }
}

// "V,15,128": what it was built with, the planner's blocks, the bytes of the receive buffer.
void GrblMachine::hear_options(std::string_view options) {
  static_cast<void>(next_grbl_field(options, ','));
  const auto told_blocks = read_grbl_number(next_grbl_field(options, ','));
  const auto told_bytes = read_grbl_number(next_grbl_field(options, ','));
  if (told_blocks && *told_blocks >= 1 && *told_blocks <= 10000) blocks = static_cast<std::size_t>(*told_blocks);
  if (told_bytes && *told_bytes >= 64 && *told_bytes <= 65536) bytes = static_cast<std::size_t>(*told_bytes);
}

// "G0 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0"
void GrblMachine::hear_modes(std::string_view modes) {
  while (!modes.empty()) {
    const std::string_view mode = next_grbl_field(modes, ' ');
    if (is_system(mode)) system = mode;
  }
}

void GrblMachine::hear_offset(std::string_view name, std::string_view value) {
  auto place = read_grbl_place(value, axes);
  if (!place) return;
  // Grbl and FluidNC tell the length of the tool, grblHAL tells three numbers.
  if (name == "TLO" && value.find(',') == std::string_view::npos) {
    (*place)[Axis::z] = std::exchange((*place)[Axis::x], 0.0);
  }
  offsets[std::string(name)] = *place * unit();
}

void GrblMachine::hear_setting(std::string_view line) {
  const std::string_view name = next_grbl_field(line, '=');
  const auto number = read_grbl_number(name.substr(1));
  const auto value = read_grbl_number(line.substr(0, line.find(' ')));
  if (number && std::abs(*number) < 1e6 && value) settings[static_cast<int>(*number)] = *value;
}

bool GrblMachine::in_inches() const {
  const auto found = settings.find(13);
  return found != settings.end() && found->second != 0;
}

std::optional<Point> GrblMachine::work_zero() const {
  if (!offsets.contains(system)) return {};
  Point zero;
  for (const std::string_view name : {std::string_view(system), std::string_view("G92"), std::string_view("TLO")}) {
    const auto found = offsets.find(std::string(name));
    if (found != offsets.end()) zero = zero + found->second;
  }
  return zero;
}

}  // namespace passo
