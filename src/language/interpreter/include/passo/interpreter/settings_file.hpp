// SettingsFile: a machine's settings in LinuxCNC's ini form, as far as programs can see them.
//
//     [RS274NGC]
//     SUBROUTINE_PATH = subs:more/subs     # where subs in files are looked for
//     [VARS]
//     CHANGE_Z = 30                        # #<_ini[vars]change_z> in a program
//
// Lines that start with '#' or ';' are comments, and so is text after a blank and '#'. If a name has two values, the
// first one counts. Names are compared as in RS274/NGC: any case, without blanks.
//
// A setting that changes what programs mean is followed, or read() reports that it is not.
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

  // False: something is wrong with the file. `diagnostics` has all of it.
  [[nodiscard]] bool read(const std::string& path, Diagnostics& diagnostics);

  // Empty: there is no such setting.
  std::optional<std::string_view> find(std::string_view section, std::string_view name) const;
  std::optional<double> number(std::string_view section, std::string_view name) const;
  // True: the setting is 1, yes, true or on.
  bool is_on(std::string_view section, std::string_view name) const;
  // The value of #<_ini[section]name>: `parameter` is what stands between '<' and '>'.
  std::optional<double> parameter(std::string_view parameter) const;

  // The units of [TRAJ], or in old files of [AXIS], [AXIS_X] or [JOINT_0].
  std::optional<LengthUnits> machine_units() const;
  // [DISPLAY]PROGRAM_PREFIX, then [RS274NGC]SUBROUTINE_PATH. Relative paths start from the file's folder.
  std::vector<std::string> sub_folders() const;
  // A file that a setting names. Relative paths start from this file's folder. Empty: none.
  std::string path_of(std::string_view section, std::string_view name) const;

 private:
  bool set(std::string_view section, std::string_view name, std::string_view value);
  std::string beside(std::string_view path) const;

  std::string folder_;
  std::map<std::string, std::string, std::less<>> values_;  // by "section]name"
};

}  // namespace passo
