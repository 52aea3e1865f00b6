// The options of the commands that need a machine and no program (jog, home, serve, machine), and the options of a
// machine.
#pragma once

#include <optional>
#include <string>

#include "commands.hpp"

namespace CLI {
class App;
}

namespace passo {

void add_machine(CLI::App& command, std::string& machine);
void add_board(CLI::App& command, std::string& board);
void add_ahead(CLI::App& command, std::optional<double>& ahead);
// Adds --system, a folder with the files of another computer's system.
void add_system(CLI::App& command, std::string& system);

void add_jog_options(CLI::App& command, JogArguments& arguments);
void add_home_options(CLI::App& command, HomeArguments& arguments);
void add_serve_options(CLI::App& command, ServeArguments& arguments);
void add_machine_options(CLI::App& command, MachineArguments& arguments);

}  // namespace passo
