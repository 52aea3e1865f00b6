// Preprocesses the command line before CLI11 parses it: `passo help run` becomes `passo run --help`, and an unknown
// command or option is refused with a suggestion.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace passo {

// Returns the arguments after the program's name. "help" as the first argument becomes "--help" as the last one.
std::vector<std::string> command_words(int argc, const char* const* argv);

// Returns an error for an unknown command, or for an unknown option that begins with "--". Empty if none is found;
// CLI11 checks the other arguments.
std::string refuse_words(CLI::App& app, const std::vector<std::string>& words);

// A CLI11 check for a count: a whole number of at least 1. Returns the error; empty if valid.
std::string refuse_count(const std::string& text);

}  // namespace passo
