// SettingsFile: a machine's settings in LinuxCNC's ini form, as far as programs can see them.
//
//     [RS274NGC]
//     SUBROUTINE_PATH = subs:more/subs     # where subs in files are looked for
//     [VARS]
//     CHANGE_Z = 30                        # #<_ini[vars]change_z> in a program
//
// Lines that start with '#' or ';' are comments, and so is what follows a blank and '#'. Of two values of one name the
// first one counts. Names are compared as RS274/NGC's: any case, blanks taken out.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/interpreter/operation.hpp"

namespace passo {

class SettingsFile {
 public:
  static constexpr std::size_t most_settings = 10'000;

  // False when something is wrong with the file; all of it is in `diagnostics`.
  [[nodiscard]] bool read(const std::string& path, Diagnostics& diagnostics);

  // Nothing where there is no such setting.
  std::optional<std::string_view> find(std::string_view section, std::string_view name) const;
  std::optional<double> number(std::string_view section, std::string_view name) const;
  // The value of #<_ini[section]name>: `parameter` is what stands between '<' and '>'.
  std::optional<double> parameter(std::string_view parameter) const;

  // [TRAJ]LINEAR_UNITS, or [AXIS…] of old files.
  std::optional<LengthUnits> machine_units() const;
  // [DISPLAY]PROGRAM_PREFIX, then [RS274NGC]SUBROUTINE_PATH; beside the file where they are relative.
  std::vector<std::string> sub_folders() const;
  // A file that a setting names, beside this one; empty: none.
  std::string path_of(std::string_view section, std::string_view name) const;

 private:
  bool set(std::string_view section, std::string_view name, std::string_view value);
  std::string beside(std::string_view path) const;

  std::string folder_;
  std::map<std::string, std::string, std::less<>> values_;  // by "section]name"
};

}  // namespace passo
