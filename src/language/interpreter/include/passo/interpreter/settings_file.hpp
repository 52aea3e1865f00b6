// SettingsFile: a machine's settings in LinuxCNC's ini format, as far as programs can read them.
//
//     [RS274NGC]
//     SUBROUTINE_PATH = subs:more/subs     # search path for subroutine files
//     [VARS]
//     CHANGE_Z = 30                        # #<_ini[vars]change_z> in a program
//
// Lines that start with '#' or ';' are comments, and so is text after a blank and '#'. If a name has two values, the
// first one is used. Names are compared as in RS274/NGC: ignoring case and blanks.
//
// A setting that changes the meaning of programs is either supported, or read() reports that it is not.
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

  // Returns false if the file has errors, all of which are in `diagnostics`.
  [[nodiscard]] bool read(const std::string& path, Diagnostics& diagnostics);

  // Empty if there is no such setting.
  std::optional<std::string_view> find(std::string_view section, std::string_view name) const;
  std::optional<double> number(std::string_view section, std::string_view name) const;
  // Returns whether the setting is 1, yes, true or on.
  bool is_on(std::string_view section, std::string_view name) const;
  // Returns the value of #<_ini[section]name>: `parameter` is the text between '<' and '>'.
  std::optional<double> parameter(std::string_view parameter) const;

  // Returns the units of [TRAJ], or in old files of [AXIS], [AXIS_X] or [JOINT_0].
  std::optional<LengthUnits> machine_units() const;
  // Returns [DISPLAY]PROGRAM_PREFIX, then [RS274NGC]SUBROUTINE_PATH. Relative paths are relative to the file's folder.
  std::vector<std::string> sub_folders() const;
  // Returns the path of a file named by a setting. Relative paths are relative to this file's folder. Empty: none.
  std::string path_of(std::string_view section, std::string_view name) const;

 private:
  bool set(std::string_view section, std::string_view name, std::string_view value);
  std::string beside(std::string_view path) const;

  std::string folder_;
  std::map<std::string, std::string, std::less<>> values_;  // by "section]name"
};

}  // namespace passo
