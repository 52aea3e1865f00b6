// DriveOptions: the options of a drive, in addition to its path.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "passo/drive/feed.hpp"
#include "passo/drive/rewindable_path.hpp"
#include "passo/drive/stop_ramp_options.hpp"
#include "passo/path/segment.hpp"

namespace passo {

class HostSpindle;

struct DriveOptions {
  // For a board on a link. The board's queue always ends in a stop, and after an interruption of the link, the drive
  // continues from there. Empty: items go to the board directly.
  std::optional<StopRampOptions> tails = {};
  Commitment live = endless_commitment;  // only for a board without a link
  // The start in the middle of a path. An earlier session has executed everything before this position.
  std::optional<PathPosition> begin_at = {};
  // Leads from the current position to `begin_at`, and ends in a stop. Empty: the machine is already there.
  std::vector<PathItem> lead_in = {};
  Seconds not_before{0};            // no motion before this time on the board's side
  Seconds spindle_wait{0};          // before motion continues, after the board had switched its outputs off
  Seconds spindle_run_up{0};        // from standstill to 1000 rpm; the wait is at least as long as the run-up
  Seconds coolant_wait{0};          // from the coolant's outputs to motion, where these were off; see collet_wait()
  int counts_per_turn = 0;          // counts per revolution of the spindle's encoder; 0: nothing follows the spindle
  bool guards_by_probe = false;     // a probe contact outside a probe move stops the drive
  bool waits_for_operator = false;  // at stops (M0, M1) and tool changes (M6)
  bool waits_at_optional = true;    // also at M1, if it waits for the operator at all
  std::uint8_t kept_in_stops = 0;   // bits of OutputSwitch: digital outputs that stay on in holds and stop ramps
  std::uint8_t switches = 0;        // the digital outputs that are on at the start of the path
  bool stops_at_lines = false;      // holds after each line of the program
  bool may_stop_at_lines = false;   // stop_at_lines() may be called later
  const HostSpindle* spindle = nullptr;  // whose speed motion waits for; null: the board's
};

}  // namespace passo
