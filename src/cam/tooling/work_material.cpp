#include "passo/tooling/work_material.hpp"

#include <algorithm>
#include <array>

namespace passo {
namespace {

constexpr std::array<std::string_view, 10> names = {"softwood", "hardwood", "plywood", "mdf",       "acrylic",
                                                    "hdpe",     "fr4",      "foam",    "aluminium", "brass"};
static_assert(names.size() == static_cast<std::size_t>(WorkMaterial::brass) + 1);

}  // namespace

std::string_view name_of(WorkMaterial material) {
  return names[static_cast<std::size_t>(material)];
}

std::optional<WorkMaterial> work_material_of(std::string_view name) {
  const auto* const found = std::ranges::find(names, name);
  if (found == names.end()) return std::nullopt;
  return static_cast<WorkMaterial>(found - names.begin());
}

std::span<const std::string_view> work_material_names() {
  return names;
}

}  // namespace passo
