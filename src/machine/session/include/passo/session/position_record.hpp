// PositionRecord: a file about a board, from which the next host can determine the machine position.
//
// A board counts the steps of its motors as long as it has power. The record holds the counts at machine zero, and the
// session numbers that identify the board. Nothing has to be written while the machine moves: the position follows from
// the board's counts, even if the host was killed during motion. The counts of a board that was reset, was connected to
// another host or has stopped its motors instantly are not trusted.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/journal/session_numbers.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/session/known_position.hpp"

namespace passo {

struct PositionRecord {
  std::uint64_t machine = 0;     // place_fingerprint() of the machine
  Trust trust = Trust::unknown;  // unknown: machine zero is unknown, but counting continues
  std::vector<int> zero_counts;  // the board's count of each motor at machine zero
  SessionNumbers numbers;
  bool is_lost = false;  // as in KnownPosition
  friend bool operator==(const PositionRecord&, const PositionRecord&) = default;
};

// A hash of everything in a machine file that relates counts to positions: the axes in their order, their scales and
// switches.
std::uint64_t place_fingerprint(const MachineDescription& machine);

std::string text_of(const PositionRecord& record);
// Empty: the text is not a complete record.
std::optional<PositionRecord> read_place_record(std::string_view text);

// Why a board's counts do not determine the machine position.
enum class PositionDoubt : std::uint8_t {
  no_record,        // there is no record of this board, or its position was unknown then
  other_machine,    // the record belongs to another machine file, or the file was changed
  board_reset,      // the board was reset or switched off
  other_session,    // another host has connected to the board
  session_ended,    // the machine was moved with the board's keypad, or a host has only sent a hello
  stopped_at_once,  // the motors may have lost steps
  drivers_off,      // the drivers were off, so the axes may have moved
};
// A sentence without a full stop.
std::string_view message_of(PositionDoubt doubt);

// The machine position. `record` may be empty. The status must be that of a stopped board.
Result<KnownPosition, PositionDoubt> place_of(const std::optional<PositionRecord>& record,
                                              const MachineDescription& machine, const BoardStatus& status);

// The position from the board's counts only, even if place_of() does not trust it. It only continues the coordinates of
// the previous host, so that the work zero stays where it was set. Empty: the counts are not those of the record.
std::optional<Point> counted_place(const std::optional<PositionRecord>& record, const MachineDescription& machine,
                                   const BoardStatus& status);

}  // namespace passo
