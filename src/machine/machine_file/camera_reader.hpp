// Reads [camera]: the addresses of the camera, its offset from the spindle, and how its picture is turned.
#pragma once

#include "passo/machine_file/camera_description.hpp"
#include "passo/toml/table_reader.hpp"

namespace passo {

CameraDescription read_camera(TableReader& reader);

}  // namespace passo
