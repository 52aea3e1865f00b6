// PlaceRecord: what a host writes down of a board, so that the next host knows where the machine stands.
//
// A board counts the steps of its motors as long as it has power. The record holds the counts at machine zero, and the
// numbers by which the board is recognised. So nothing has to be written while the machine moves: the place is what the
// board has counted since, also after the host was killed in mid-run. A board that was reset, has heard another host or
// has stopped its motors at once is not believed.
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

struct PlaceRecord {
  std::uint64_t machine = 0;     // place_fingerprint() of the machine
  Trust trust = Trust::unknown;  // unknown: nobody knows where machine zero is, and the counts go on all the same
  std::vector<int> zero_counts;  // the board's count of each motor at machine zero
  SessionNumbers numbers;
  bool is_lost = false;  // as in KnownPosition
  friend bool operator==(const PlaceRecord&, const PlaceRecord&) = default;
};

// Of everything in a machine file that makes a place of counts: the axes in their order, their scales and switches.
std::uint64_t place_fingerprint(const MachineDescription& machine);

std::string text_of(const PlaceRecord& record);
// Nothing: the text is no whole record.
std::optional<PlaceRecord> read_place_record(std::string_view text);

// Why a board's counts do not tell where the machine stands.
enum class PlaceDoubt : std::uint8_t {
  no_record,        // no host has written of this board, or a place was not known then
  other_machine,    // the record is of another machine file, or the file has changed
  board_reset,      // the board was reset or switched off
  other_session,    // another host has said hello to the board
  session_ended,    // a person has moved the machine by the board's keypad, or a host has said hello and nothing else
  stopped_at_once,  // the motors may have lost steps
  drivers_off,      // the drivers were off, so the axes may have moved
};
// A sentence without a full stop.
std::string_view message_of(PlaceDoubt doubt);

// Where the machine stands. `record` may be empty. The status must be one at rest.
Result<KnownPosition, PlaceDoubt> place_of(const std::optional<PlaceRecord>& record, const MachineDescription& machine,
                                           const BoardStatus& status);

// The place by the board's counts alone, also where place_of() does not trust it. It is no more than where the machine
// stood for the host before: the work's zero stays where somebody has set it. Empty: the counts are not those of the
// record.
std::optional<Point> counted_place(const std::optional<PlaceRecord>& record, const MachineDescription& machine,
                                   const BoardStatus& status);

}  // namespace passo
