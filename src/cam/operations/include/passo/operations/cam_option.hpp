// CamOption: one option of an operation of `passo cam`, or of a study: name, permitted values, help text, and the
// member that holds its value. The command-line options, the checks of the API, the form of the web interface and the
// tables of the manual are generated from these rows.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace passo {

enum class CamKind : std::uint8_t {
  drawings,  // the input files of an operation; unnamed on the command line
  flag,
  choice,   // one of `choices`
  place,    // one of `choices`, or a position X,Y
  file,     // a file name, or one of `choices`
  text,     // free text, e.g. a cutter or letters
  length,   // one length, or several separated by commas
  feed,     // a length per minute, e.g. a feed rate
  number,   // a number without a unit
  degrees,  // an angle; a number like the following kinds
  percent,
  turns,    // rpm
  removal,  // a removal rate, mm³/min
};

// The users to whom an option is shown.
enum class CamFor : std::uint8_t {
  everyone,
  experts,       // rarely needed: the web interface shows it under "More options"
  programs,      // intended for programs; hidden in the web interface
  command_line,  // not accepted by the API either: local files, and console output
};

struct CamRange {
  double least;
  double most;
};

// The member that holds the value. A list option may be repeated.
using CamValue = std::variant<std::string*, std::vector<std::string>*, bool*, double*, std::uint32_t*, std::uint64_t*,
                              std::optional<double>*, std::optional<std::uint32_t>*>;

// Traits that only few options have.
struct CamTraits {
  std::vector<std::string_view> choices = {};
  std::optional<CamRange> range = {};
  CamFor matters_to = CamFor::everyone;
  std::string_view usual = {};   // the effective value if the option is empty
  bool is_of_job = false;        // specific to one drawing or job: not saved for a machine
  bool is_of_machine = false;    // the machine file may set another default
  std::string_view letter = {};  // short form: "o" stands for -o
  bool is_required = false;      // the option must be given; for kind `drawings`: at least one file
  int most_files = 0;            // for kind `drawings`: maximum number of files; 0: any number
  std::string_view names = {};   // for kind `file`: what a value that is not a file names; empty: nothing
};

struct CamOption {
  std::string_view name;  // name of the option, without "--"
  CamValue value;
  CamKind kind;
  std::string_view help;
  CamTraits traits = {};
};

inline bool is_number(CamKind kind) {
  return kind >= CamKind::number;
}

// Returns whether the option may be repeated.
inline bool is_list(const CamOption& option) {
  return std::holds_alternative<std::vector<std::string>*>(option.value);
}

// Returns the current value in command-line form; empty: no value, or a flag that is not set.
std::string text_of(const CamOption& option);

}  // namespace passo
