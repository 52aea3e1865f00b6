// Describes a board's information and status, as text and as JSON.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "passo/link/board_session.hpp"
#include "passo/wire/message.hpp"

namespace passo {

// An Arduino whose line was just opened is in its boot loader for a second or two. So it is asked again and again.
inline constexpr LinkTimeouts inquiry_care{.answer_within = Seconds(0.25), .patience = Seconds(3600)};

std::string name_of(const About& about);
// Formats a version number given in hundredths: 1.02.
std::string version_of(const About& about);
// Returns e.g. "limit X", "probe"; empty if all switches are open.
std::vector<std::string> switches_of(const BoardStatus& status);
// Queries a board that has stopped its motors instantly. The switch that caused it may still be closed: returns ";
// closed now: limit 1", or an empty text. Ends the communication with the board.
std::string closed_switches(BoardSession& board);
std::string state_of(const BoardStatus& status);
std::string reset_of(const BoardStatus& status);

// Returns why a board that was asked with `inquiry_care` has told nothing about itself.
std::string silence_of(const BoardSession& board);

nlohmann::json to_json(const About& about);
nlohmann::json to_json(const BoardStatus& status);

}  // namespace passo
