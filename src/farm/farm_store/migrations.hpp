// The migrations of a farm's database: the files of migrations/, in their order. Forwards only. Private to farm_store/.
#pragma once

#include <span>
#include <string_view>

namespace passo {

struct Migration {
  std::string_view name;  // of its file, without .sql
  // Statements for both engines; {identity} stands for Database::identity_column().
  std::string_view statements;
};

// Generated from the files (CMakeLists.txt).
std::span<const Migration> migrations();

}  // namespace passo
