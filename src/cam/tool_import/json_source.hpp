// JsonSource: a JSON file of another program, whose members are read one by one, and what of it was never read. Private
// to tool_import/.
//
// The file is hostile: its size and depth are limited before anything is kept.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include <nlohmann/json.hpp>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/tool_import/tool_import.hpp"

namespace passo {

class JsonSource {
 public:
  using Json = nlohmann::json;
  static constexpr std::size_t largest = std::size_t{16} << 20U;  // bytes
  static constexpr int deepest = 32;

  static std::optional<JsonSource> parse(std::string_view text, const std::string& file, Diagnostics& diagnostics);

  const Json& root() const { return root_; }
  // Returns a member of an object, or null.
  static const Json* find(const Json& object, const char* key);
  // Read a member and record it as used. Empty: there is none, or it has another type.
  std::optional<double> number(const Json& object, const char* key);
  // The number of a tool: whole, 0 to 99,999.
  std::optional<std::int32_t> tool_number(const Json& object, const char* key);
  std::optional<std::string> text(const Json& object, const char* key);
  std::optional<bool> flag(const Json& object, const char* key);
  // Records a value with all that is in it as used.
  void use(const Json& value) { used_.insert(&value); }
  // Lists the values that were not used. Elements of a list count as one field: "/data/*/guid".
  std::vector<UnusedField> unused() const;

 private:
  Json root_;
  std::unordered_set<const Json*> used_;
};

}  // namespace passo
