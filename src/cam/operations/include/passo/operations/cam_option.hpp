// CamOption: one option of an operation of `passo cam`, or of a study: name, permitted values, help text, and the
// member that holds its value. The options of the command line, the checks of the API, the form of the page and the
// tables of the manual come from these rows.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace passo {

enum class CamKind : std::uint8_t {
  drawings,  // the files that an operation reads; they have no name on the command line
  flag,
  choice,   // one of `choices`
  place,    // one of `choices`, or X,Y
  file,     // a file's name, or one of `choices`
  text,     // words and numbers: a cutter, letters
  length,   // or several with commas between
  feed,     // a length a minute
  number,   // without a unit
  degrees,  // also numbers, as the next ones
  percent,
  turns,    // a minute
  removal,  // mm3 a minute
};

// For whom an option matters.
enum class CamFor : std::uint8_t {
  everyone,
  experts,       // few need it: the page shows it under "More options"
  programs,      // the page does not show it
  command_line,  // the API does not take it either: files of this computer, and what is printed
};

struct CamRange {
  double least;
  double most;
};

// The member that holds the value. A list: the option may be given again.
using CamValue = std::variant<std::string*, std::vector<std::string>*, bool*, double*, std::uint32_t*, std::uint64_t*,
                              std::optional<double>*, std::optional<std::uint32_t>*>;

// What few options have.
struct CamTraits {
  std::vector<std::string_view> choices = {};
  std::optional<CamRange> range = {};
  CamFor matters_to = CamFor::everyone;
  std::string_view usual = {};   // what counts where the value is empty
  bool is_of_job = false;        // it speaks of one drawing or one job: it is not remembered for a machine
  bool is_of_machine = false;    // the machine file may have another default
  std::string_view letter = {};  // "o": -o is the same
  bool is_required = false;
  int most_files = 0;  // of drawings; 0: any number
};

struct CamOption {
  std::string_view name;  // without "--"
  CamValue value;
  CamKind kind;
  std::string_view help;
  CamTraits traits = {};
};

inline bool is_number(CamKind kind) {
  return kind >= CamKind::number;
}

// Whether it may be given again.
inline bool is_list(const CamOption& option) {
  return std::holds_alternative<std::vector<std::string>*>(option.value);
}

// What stands there now, as the command line would say it; empty: nothing, or a flag that is not set.
std::string text_of(const CamOption& option);

}  // namespace passo
