// The output of `passo simulate`: figures as text or JSON.
#pragma once

#include <string>

#include "passo/cutting/simulation.hpp"

namespace passo {

std::string to_text(const Simulation& simulation);
std::string to_json(const Simulation& simulation, const Diagnostics& findings);
// Returns the text below a picture's title.
std::string in_short(const Simulation& simulation);

}  // namespace passo
