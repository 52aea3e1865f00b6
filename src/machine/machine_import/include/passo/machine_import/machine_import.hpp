// import_machine: makes a machine file (TOML) from the configuration of another controller.
//
// The mapping is the same source in the program and in a browser: no files, no exceptions, no library but fmt.
// docs/manual/machine-import.md has the table of the keys.
//
// Invariants: each number of the machine file comes from the source, or is listed in `assumed` and marked "assumed" in
// the file. Each key of the source is in `understood` or in `unmapped`. The text is a valid machine file (the tests
// read each one with parse_machine()).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/machine_import/source_tree.hpp"

namespace passo {

enum class ImportFormat : std::uint8_t {
  settings,  // what Grbl 1.1, grblHAL or FluidNC answer to $$
  fluidnc,   // FluidNC's configuration, YAML
  linuxcnc,  // LinuxCNC's ini file
  mach3,     // a profile of Mach3, XML
};

// "settings", "fluidnc", "linuxcnc", "mach3": as in --format. format_of() returns nothing for another name.
std::string_view name_of(ImportFormat format);
std::optional<ImportFormat> import_format_of(std::string_view name);

// The format of a file by its content, whatever its name is. Nothing: none of the formats.
std::optional<ImportFormat> detect_import_format(std::string_view text);

// A value of the source, and where it went.
struct UnderstoodValue {
  std::string source;      // "$110", "[JOINT_0]SCALE", "axes/x/steps_per_mm", "Steps0"
  std::string value;       // as in the source
  std::string target;      // "axis.X.max_velocity_mm_s = 25"
  std::uint32_t line = 0;  // 0: unknown
};

// A value of the source that is not in the machine file.
struct UnmappedValue {
  std::string source;
  std::string value;
  std::string reason;  // a sentence without a full stop; empty: the key is unknown
  std::uint32_t line = 0;
};

// A value that a machine file needs and the source does not have.
struct AssumedValue {
  std::string target;  // "board.clock_hz = 16000000"
  std::string reason;
};

struct ImportedMachine {
  ImportFormat format = ImportFormat::settings;
  std::string controller = {};  // "Grbl", "grblHAL", "FluidNC", "LinuxCNC", "Mach3"
  std::string toml = {};
  std::vector<UnderstoodValue> understood = {};
  std::vector<UnmappedValue> unmapped = {};
  std::vector<AssumedValue> assumed = {};
  std::vector<std::string> warnings = {};  // sentences: what the machine file cannot say, and what to check
};

// The file that a tree comes from: its name and its lines, for the diagnostics. The text may be empty.
struct ImportSource {
  std::string file;
  std::string_view text;
};

// Maps a tree to a machine file. Returns nothing, and adds a diagnostic "import.*", if the tree does not describe a
// machine that a machine file can describe: no axis, kinematics other than one motor (or two) an axis, a value that is
// not a number or is outside its range.
std::optional<ImportedMachine> import_machine(ImportFormat format, const SourceNode& tree, const ImportSource& source,
                                              Diagnostics& diagnostics);

// The readers of the two formats that have no library. They return nothing, and add a diagnostic, if the text is none.
std::optional<SourceNode> parse_settings_dump(const ImportSource& source, Diagnostics& diagnostics);
std::optional<SourceNode> parse_ini(const ImportSource& source, Diagnostics& diagnostics);

// What was understood, assumed, not understood, and the warnings, as a text for people.
std::string describe(const ImportedMachine& machine);

}  // namespace passo
