// GrblFirmware: what distinguishes the firmwares that speak the protocol of Grbl 1.1, one description each.
//
// This is the only place where they differ: GrblMachine recognizes the firmware by its row, and the rest of the sender
// asks the row. A firmware that no row describes is treated as Grbl 1.1. A new firmware needs a row in
// grbl_firmware.cpp, a fake in tests/kit/firmware_fakes.hpp, and a line in docs/manual/grbl-machines.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "passo/grbl_meanings/grbl_meanings.hpp"

namespace passo {

struct GrblFirmware {
  // How the board measures the way to which F applies, if a move turns a rotary axis and also moves a linear one.
  enum class FeedWay : std::uint8_t {
    all_axes,         // the root of the sum of squares over all axes, mm and degrees alike
    depends_on_build  // that, or the linear axes alone; inverse time (G93) means the same in each build
  };
  // Where the settings are.
  enum class Settings : std::uint8_t {
    numbers,    // $0 …, stored by the board at once
    described,  // the same, and the board describes them ($ES)
    yaml        // in a YAML file on the board; the numbers only show some of them
  };
  static constexpr int at_any_time = -1;

  std::string_view name;  // as in GrblMachine::firmware
  // Occurs in its greeting, in [VER:…] or in [FIRMWARE:…], in upper or lower case. Empty: it does not name itself.
  std::string_view mark;
  std::string_view axes;       // letters of the axes in the order of its reports, if it does not tell them
  std::size_t unusable_bytes;  // of the receive buffer that it reports
  bool sizes_are_last;         // blocks and bytes are the last fields of [OPT:…], not the second and third
  bool tells_mist;             // 'M' in [OPT:…] says whether M7 exists; without it M7 is rejected
  bool tells_core_xy;          // 'C' in [OPT:…] says that it was built for a CoreXY
  bool measures_motors;        // built for a CoreXY ('C' in [OPT:…]), it applies F to the way of the two motors
  bool homes_single_axes;      // it knows $HX, whatever [OPT:…] says; others have 'H' there if they do
  bool converts_angles;        // with $13=1 the values of rotary axes are divided by 25.4 too
  // It sends its modes ([GC:…]) also unasked, between other lines, if $10 has this bit. 0: never.
  int unasked_modes;
  FeedWay feed_way;
  Settings settings;
  std::span<const std::string_view> questions;  // asked after $I, with answers that may be errors
  std::string_view save;                        // asked after settings were written; empty: they are saved at once
  std::span<const GrblMeaning> errors;          // those that differ from Grbl's
  std::span<const GrblMeaning> alarms;
};

// The first row is Grbl 1.1.
std::span<const GrblFirmware> grbl_firmwares();
// Returns the row of a name, or Grbl 1.1.
const GrblFirmware& grbl_firmware(std::string_view name);
// Returns the firmware whose mark occurs in the text; null if there is none.
const GrblFirmware* marked_grbl_firmware(std::string_view text);

// Returns the words for a number; empty if neither the firmware nor Grbl 1.1 has it.
std::string_view meaning_of_grbl_error(std::string_view firmware, int number);
std::string_view meaning_of_grbl_alarm(std::string_view firmware, int number);

}  // namespace passo
