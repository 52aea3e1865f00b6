#include "command_table.hpp"

#include <CLI/CLI.hpp>

namespace passo {
namespace {

// Whether the words name this command, or one of its own.
bool is_named(const CLI::App& command, const std::vector<std::string>& words) {
  std::vector<std::string> path;
  for (const CLI::App* part = &command; part->get_parent() != nullptr; part = part->get_parent()) {
    path.push_back(part->get_name());
  }
  for (const std::string& word : words) {
    if (path.empty()) break;
    if (word.starts_with('-')) continue;
    if (word != path.back()) return false;
    path.pop_back();
  }
  return path.empty();
}

}  // namespace

std::function<int()> add_commands(CLI::App& parent, std::span<const Command> commands,
                                  const std::vector<std::string>& words) {
  std::function<int()> chosen;
  for (const Command& row : commands) {
    CLI::App& command = *parent.add_subcommand(row.name, row.purpose);
    if (!is_named(command, words)) continue;
    if (row.add_options != nullptr) chosen = row.add_options(command);
    if (row.commands.empty()) continue;
    command.require_subcommand(1);
    chosen = add_commands(command, row.commands, words);
  }
  return chosen;
}

void add_all_commands(CLI::App& parent, std::span<const Command> commands) {
  for (const Command& row : commands) {
    CLI::App& command = *parent.add_subcommand(row.name, row.purpose);
    if (row.add_options != nullptr) row.add_options(command);
    add_all_commands(command, row.commands);
  }
}

}  // namespace passo
