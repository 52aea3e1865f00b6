// What would make a program run on this machine, as text and JSON.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "passo/judge/proposals.hpp"

namespace passo {

// A line for each, with a line end.
std::string to_text(const std::vector<Proposal>& proposals);
nlohmann::ordered_json as_json(const std::vector<Proposal>& proposals);

}  // namespace passo
