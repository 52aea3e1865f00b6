#include "hooks_reader.hpp"

#include <string>
#include <variant>

#include "code_lines_reader.hpp"

namespace passo {

ProgramHooks read_hooks(const TomlEntry& entry, const TomlReporter& reporter,
                        const std::function<void(TableReader&)>& finish) {
  const TomlTable& table = std::get<TomlTable>(entry.value.content);
  TableReader reader(table, "hooks", entry.place, reporter);
  ProgramHooks hooks;
  const auto read = [&](std::string_view key, std::string& lines) {
    reader.know(key);
    const TomlEntry* const of_key = find(table, key);
    if (of_key != nullptr) lines = read_code_lines(reader, "machine.hooks", key, of_key->value);
  };
  read("at_start", hooks.at_start);
  read("at_end", hooks.at_end);
  finish(reader);
  return hooks;
}

}  // namespace passo
