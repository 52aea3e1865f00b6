// A table of commands: how each is called, what the help says of it, and how it gets its options. main.cpp has the
// table of `passo`; `cam`, `board` and `follower` have one of their own.
//
// Invariant: only the command that the command line names gets options. A start would take half as long again.
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
  const char* purpose;  // a line of the help
  // Adds the options, and returns what the command does after they are parsed: a function with an exit code. Null, or
  // nothing returned: one of its own commands does it.
  std::function<int()> (*add_options)(CLI::App& command);
  std::span<const Command> commands = {};  // its own
};

// A command's add_options: Arguments are filled in by its options, and `run` gets them.
template <class Arguments, void (*add)(CLI::App&, Arguments&), int (*run)(const Arguments&)>
std::function<int()> options_of(CLI::App& command) {
  const auto arguments = std::make_shared<Arguments>();
  add(command, *arguments);
  return [arguments] { return run(*arguments); };
}

// Adds the commands to `parent`. `words` are the command line. Returns what the named command does after `parent` has
// parsed them; nothing: they name none.
std::function<int()> add_commands(CLI::App& parent, std::span<const Command> commands,
                                  const std::vector<std::string>& words);

}  // namespace passo
