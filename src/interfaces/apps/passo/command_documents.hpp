// Writes the manual pages and the shell completion of `passo`. They are made from the command line's own definition, so
// they always name every command and option.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace passo {

// Writes into `folder`: man1/passo.1 and a page for each command (passo-run.1, passo-cam-drill.1), completion/passo
// (bash), completion/_passo (zsh) and completion/passo.fish. `app` has all commands with all options. Returns an
// exit code.
int write_command_documents(const CLI::App& app, const std::string& version, const std::string& folder);

}  // namespace passo
