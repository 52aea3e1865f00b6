// The output of `passo check --cutting-force` about the cut.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "passo/cutting/cut_loads.hpp"

namespace passo {

// Adds a finding for each problem of the cut, and for feed moves without a spindle speed.
void add_findings(const CutOutcome& cut, Diagnostics& findings);
// Returns e.g. "cut             11.78 cm³ removed, ...".
std::string to_text(const CutOutcome& cut);
nlohmann::ordered_json as_json(const CutOutcome& cut);

}  // namespace passo
