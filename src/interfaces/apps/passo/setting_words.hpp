// The settings of a Grbl board as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "passo/sender/firmware_settings.hpp"

namespace passo {

nlohmann::ordered_json to_json(const FirmwareSetting& setting);
nlohmann::ordered_json to_json(const SettingChange& change);
nlohmann::ordered_json to_json(const SettingDifference& difference);

}  // namespace passo
