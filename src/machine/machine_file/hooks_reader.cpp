#include "hooks_reader.hpp"

#include "code_lines_reader.hpp"

namespace passo {

ProgramHooks read_hooks(TableReader& reader, const TomlTable& table) {
  ProgramHooks hooks;
  const auto read = [&](std::string_view key, std::string& lines) {
    reader.know(key);
    const TomlEntry* const entry = find(table, key);
    if (entry != nullptr) lines = read_code_lines(reader, "machine.hooks", key, entry->value);
  };
  read("at_start", hooks.at_start);
  read("at_end", hooks.at_end);
  return hooks;
}

}  // namespace passo
