// read_option_profile: reads command options from a file with a table for each command and a key for each option:
//
//   [isolate]
//   tool = "1,0.2"      # same as --tool 1,0.2
//   width = 0.5         # same as --width 0.5
//   clear = true        # same as --clear; false: option not given
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct OptionSection {
  std::string name;                // name of the table
  std::uint32_t line = 0;          // line in the file, from 1
  std::vector<std::string> words;  // as on a command line: "--tool", "1,0.2"
};

// `known`: the permitted names of tables. Empty if there is an error: TOML errors have codes "machine.…", others
// "profile.…".
std::optional<std::vector<OptionSection>> read_option_profile(const std::string& path,
                                                              const std::vector<std::string>& known,
                                                              Diagnostics& diagnostics);

}  // namespace passo
