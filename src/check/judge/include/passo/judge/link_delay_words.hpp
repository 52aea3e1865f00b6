// The cost of a serial link to the board, as `passo check` shows it.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "passo/judge/link_delay.hpp"

namespace passo {

// Returns one line for the output of `passo check`, with a final newline.
std::string to_text(const LinkDelay& cost);
nlohmann::ordered_json as_json(const LinkDelay& cost);

}  // namespace passo
