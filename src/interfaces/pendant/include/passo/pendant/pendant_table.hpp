// PendantTable: what the bytes of a pendant's reports mean, and what its keys do. A table is a TOML file; those of
// known pendants are built in (examples/pendants). docs/manual/pendants.md explains every key.
//
// Position in the pipeline: outside it. HID reports -> PendantDecoder -> PendantControl -> requests to the API.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/geometry/axes.hpp"
#include "passo/units/units.hpp"

namespace passo {

// What a key does.
struct PendantAction {
  enum class Kind : std::uint8_t {
    none,
    modifier,  // while it is held, other keys have their second action
    start,     // starts what waits, resumes what is held, and holds what runs
    hold,
    stop,
    reset,
    home,
    go,           // `word`: a destination of POST /go
    macro,        // `word`: the name of a macro
    zero,         // the work zero of `axis`; empty: of the selected axis
    select_axis,  // `axis`
    step_mode,
    continuous_mode,
    other_mode,
    coarser,  // the next larger step
    finer,
    feed_up,
    feed_down,
    spindle_up,
    spindle_down,
    spindle_stop,  // in a hold: stops the spindle, and starts it again
  };
  Kind kind = Kind::none;
  std::string word = {};
  std::optional<Axis> axis = {};
};

// Reads "stop", "macro:probe-z", "zero:X". Empty: there is no such action.
std::optional<PendantAction> parse_pendant_action(std::string_view text);
// Returns the forms of all actions, for messages: "stop, go:NAME, …".
std::string pendant_actions_in_words();

struct PendantKey {
  std::string name;     // as printed on the key
  unsigned number = 0;  // its code or its bit
  PendantAction action;
  PendantAction with_modifier;
};

// A position of the selector of steps.
struct PendantStep {
  unsigned value = 0;  // of the byte; not used for steps that keys select
  double step = 0;     // mm or degrees for a detent of the wheel; 0: only for continuous mode
  double share = 0;    // of the axis' highest speed in continuous mode, above 0, at most 1
};

struct PendantTable {
  static constexpr std::size_t longest_report = 64;  // bytes; a full-speed HID device sends no more
  static constexpr std::size_t most_keys = 64;
  static constexpr std::size_t most_steps = 16;
  static constexpr std::size_t most_display_fields = 32;
  static constexpr double least_share = 0.02;  // the machine does not jog more slowly

  // A byte and its value.
  struct ByteValue {
    std::size_t byte = 0;
    unsigned value = 0;
  };
  struct Wheel {
    std::size_t byte = 0;
    bool is_counter = false;  // the byte counts detents and wraps; otherwise it is the signed number of detents
    bool is_reversed = false;
    // Continuous mode: a wheel that has not moved for so long has stopped.
    Seconds pause{0.05};
  };
  // A ring with a spring: the byte is its signed position.
  struct Ring {
    std::size_t byte = 0;
    std::vector<double> shares;  // of the axis' highest speed, for each position from 1
  };
  struct AxisSelector {
    std::size_t byte = 0;
    struct Position {
      unsigned value = 0;
      Axis axis = Axis::x;
    };
    std::vector<Position> positions;  // any other value selects no axis
  };
  struct Keys {
    bool are_bits = false;  // `bytes` is a row of bits, one per key; otherwise each byte is the code of a key
    std::vector<std::size_t> bytes;
    std::vector<PendantKey> all;
  };
  // What the display shows, in the order of its bytes.
  struct DisplayField {
    enum class Kind : std::uint8_t { literal, mode, axis, feed, spindle };
    Kind kind = Kind::literal;
    std::uint8_t literal = 0;
    unsigned axis = 0;  // 1 to 3: of the three axes to which the selected one belongs
  };
  struct Display {
    bool is_feature = false;  // a feature report; otherwise an output report
    std::uint8_t id = 0;      // of the report
    std::size_t length = 0;   // of each report with its id; longer contents take several reports
    std::vector<DisplayField> fields;
  };

  std::string name;
  std::uint16_t vendor = 0;  // USB ids
  std::uint16_t product = 0;
  std::size_t length = 0;               // of a report, with its id
  std::optional<std::uint8_t> id = {};  // the first byte; reports with other ids are ignored
  std::vector<ByteValue> no_link = {};  // bytes of a report that says that the transmitter is off
  std::optional<Seconds> silence = {};  // a pendant that is silent for longer counts as gone
  std::optional<Wheel> wheel = {};
  std::optional<Ring> ring = {};
  std::optional<AxisSelector> axis_selector = {};
  std::optional<std::size_t> step_byte = {};  // of the selector of steps; empty: keys select
  std::vector<PendantStep> steps = {};        // those above 0 ascend; there is one if there is a wheel
  double step_share = 0.5;                    // of the axis' highest speed in step mode
  Keys keys = {};
  std::optional<Display> display = {};
};

// `file` names the table in diagnostics, whose codes begin with "pendant.". Nothing: it has errors.
std::optional<PendantTable> parse_pendant_table(std::string text, const std::string& file, Diagnostics& diagnostics);

// The tables of known pendants.
std::span<const PendantTable> known_pendants();

}  // namespace passo
