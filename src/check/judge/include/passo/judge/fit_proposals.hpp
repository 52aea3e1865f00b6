// Proposals that would let a program run on this machine, as text and JSON.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "passo/judge/proposals.hpp"

namespace passo {

// Returns one line per proposal, each with a final newline.
std::string to_text(const std::vector<Proposal>& proposals);
nlohmann::ordered_json as_json(const std::vector<Proposal>& proposals);

}  // namespace passo
