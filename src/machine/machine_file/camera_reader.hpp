// Reads [camera]: the addresses of the camera, its offset from the spindle, and how its picture is turned.
#pragma once

#include <functional>

#include "passo/machine_file/camera_description.hpp"
#include "passo/toml/table_reader.hpp"

namespace passo {

// Reports what is wrong with the table; parse_camera() reads it. `end` is called with the table that was read.
void check_camera(const TomlEntry& entry, const TomlReporter& reporter, const std::function<void(TableReader&)>& end);

}  // namespace passo
