// The test input for adaptive feed (M52): the machine's own feed factor over time, from a file.
//
// The file is a table in CSV: a time in seconds and a factor from 0 to 1 in each line, in order of time. A factor
// holds until the next line. A header line, empty lines and lines that begin with # are skipped.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct AdaptiveFeedChange {
  Seconds at{0};  // since the start of the program
  double factor = 1;
};

// Returns nothing, and adds diagnostics with codes "adaptive-feed.*", if the file cannot be read or is faulty. A file
// may have at most 64 MiB.
std::optional<std::vector<AdaptiveFeedChange>> read_adaptive_feed(const std::string& path, Diagnostics& diagnostics);

// The same for a text in memory. `file` names it in diagnostics.
std::optional<std::vector<AdaptiveFeedChange>> parse_adaptive_feed(std::string_view text, const std::string& file,
                                                                   Diagnostics& diagnostics);

}  // namespace passo
