#include "passo/tooling/work_material.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

namespace passo {
namespace {

constexpr std::array<std::string_view, 10> names = {"softwood", "hardwood", "plywood", "mdf",       "acrylic",
                                                    "hdpe",     "fr4",      "foam",    "aluminium", "brass"};
static_assert(names.size() == static_cast<std::size_t>(WorkMaterial::brass) + 1);

// Other words for a material, as in "birch plywood" or "aluminium 6082". A word of an earlier row counts more: birch
// plywood is plywood.
struct MaterialWords {
  WorkMaterial material;
  std::array<std::string_view, 14> words;
};
constexpr std::array<MaterialWords, 10> other_words = {{
    {WorkMaterial::plywood, {"plywood", "multiplex"}},
    {WorkMaterial::mdf, {"mdf", "hdf"}},
    {WorkMaterial::acrylic, {"acrylic", "plexiglass", "plexiglas", "perspex", "pmma"}},
    {WorkMaterial::hdpe, {"hdpe", "delrin", "acetal", "pom", "polyethylene"}},
    {WorkMaterial::fr4, {"fr4", "fibreglass", "fiberglass"}},
    {WorkMaterial::foam, {"foam", "polystyrene", "styrofoam", "eps", "xps", "polyurethane"}},
    {WorkMaterial::aluminium, {"aluminium", "aluminum", "6061", "6082", "5083", "7075"}},
    {WorkMaterial::brass, {"brass"}},
    {WorkMaterial::softwood, {"softwood", "pine", "spruce", "fir", "larch", "cedar"}},
    {WorkMaterial::hardwood,
     {"hardwood", "oak", "beech", "maple", "ash", "birch", "walnut", "cherry", "alder", "poplar", "lime", "pear",
      "mahogany", "elm"}},
}};

std::optional<WorkMaterial> material_of_words(std::string_view name) {
  std::string text = " ";
  for (const char c : name) {
    const auto letter = static_cast<unsigned char>(c);
    text += std::isalnum(letter) != 0 ? static_cast<char>(std::tolower(letter)) : ' ';
  }
  text += ' ';
  for (const MaterialWords& row : other_words) {
    for (const std::string_view word : row.words) {
      if (!word.empty() && text.find(" " + std::string(word) + " ") != std::string::npos) return row.material;
    }
  }
  return std::nullopt;
}

}  // namespace

std::string_view name_of(WorkMaterial material) {
  return names[static_cast<std::size_t>(material)];
}

std::optional<WorkMaterial> work_material_of(std::string_view name) {
  const auto* const found = std::ranges::find(names, name);
  if (found == names.end()) return material_of_words(name);
  return static_cast<WorkMaterial>(found - names.begin());
}

std::span<const std::string_view> work_material_names() {
  return names;
}

}  // namespace passo
