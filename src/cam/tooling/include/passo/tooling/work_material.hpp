// WorkMaterial: the material of the stock. Each has a row in the tables of chip loads (cutting_feeds.hpp).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace passo {

enum class WorkMaterial : std::uint8_t { softwood, hardwood, plywood, mdf, acrylic, hdpe, fr4, foam, aluminium, brass };

// "softwood", "plywood", …, as on the command line and in files.
std::string_view name_of(WorkMaterial material);
std::optional<WorkMaterial> work_material_of(std::string_view name);
// All names, in the order of the enumerators.
std::span<const std::string_view> work_material_names();

}  // namespace passo
