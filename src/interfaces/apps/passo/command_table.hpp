// A table of commands: the name of each, its description in the help, and how its options are added. main.cpp has the
// table of `passo`; `cam`, `board` and `follower` have separate tables.
//
// Invariant: only the command named in the command line adds its options, because adding all options would make a start
// 50 % slower.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace passo {

struct Command {
  const char* name;
  const char* purpose;  // one line of the help
  // Adds the options, and returns the function to call after parsing; it returns an exit code. Null, or nothing
  // returned: one of the subcommands runs.
  std::function<int()> (*add_options)(CLI::App& command);
  std::span<const Command> commands = {};  // its subcommands
};

// Implements add_options: the options fill in Arguments, which are passed to `run`.
template <class Arguments, void (*add)(CLI::App&, Arguments&), int (*run)(const Arguments&)>
std::function<int()> options_of(CLI::App& command) {
  const auto arguments = std::make_shared<Arguments>();
  add(command, *arguments);
  return [arguments] { return run(*arguments); };
}

// Adds the commands to `parent`. `words` is the command line. Returns the function of the named command, to be called
// after `parent` has parsed the command line; nothing if no command is named.
std::function<int()> add_commands(CLI::App& parent, std::span<const Command> commands,
                                  const std::vector<std::string>& words);

// Adds the commands to `parent`, each with all its options: for documents of the whole command line.
void add_all_commands(CLI::App& parent, std::span<const Command> commands);

}  // namespace passo
