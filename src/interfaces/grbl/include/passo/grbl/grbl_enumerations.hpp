// The enumerations by which grblHAL describes itself: settings ($ES), their groups ($EG), alarms ($EA) and errors
// ($EE). Senders that know grblHAL build their settings pages and messages from them.
//
// Formats and the numbers of groups and datatypes: report.c and settings.h of github.com/grblHAL/core, and the answers
// of its simulator.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "passo/grbl/grbl_settings.hpp"

namespace passo {

// Returns the answer to "$ES", "$EG", "$EA" or "$EE": whole lines. Empty: it is another command. `axes`: the letters of
// the axes of the settings; `is_kept`: their values are in the machine file, and take effect at the next start.
std::optional<std::string> grbl_enumeration(std::string_view command, std::span<const GrblSetting> settings,
                                            std::string_view axes, bool is_kept);

}  // namespace passo
