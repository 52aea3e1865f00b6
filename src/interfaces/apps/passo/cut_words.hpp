// What `passo check --cutting-force` says of the cut.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "passo/cutting/cut_loads.hpp"

namespace passo {

// Adds a finding for each trouble of the cut, and for feeds without a spindle speed.
void add_findings(const CutOutcome& cut, Diagnostics& findings);
// "cut             11.78 cm³ removed, ...".
std::string to_text(const CutOutcome& cut);
nlohmann::ordered_json as_json(const CutOutcome& cut);

}  // namespace passo
