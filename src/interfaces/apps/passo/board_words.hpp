// Tells what a board says of itself, in words and as JSON.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "passo/link/board_session.hpp"
#include "passo/wire/message.hpp"

namespace passo {

std::string name_of(const About& about);
// A version number of hundreds and units: 1.02.
std::string version_of(const About& about);
// "limit X", "probe"; empty if all switches are off.
std::vector<std::string> switches_of(const BoardStatus& status);
// Asks a board that has stopped its motors at once. The switch that did it may still be closed: "; closed now: limit
// 1", or nothing. Ends the conversation with the board.
std::string closed_switches(BoardSession& board);
std::string state_of(const BoardStatus& status);
std::string reset_of(const BoardStatus& status);

nlohmann::json to_json(const About& about);
nlohmann::json to_json(const BoardStatus& status);

}  // namespace passo
