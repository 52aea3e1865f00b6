// The words of the command line before CLI11 parses them: `passo help run` is `passo run --help`, and an unknown
// command or option is refused with the name that was probably meant.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace passo {

// The words after the program's name. "help" in the first place becomes "--help" in the last place.
std::vector<std::string> command_words(int argc, const char* const* argv);

// Why the words cannot be a command line of `app`: an unknown command, or an unknown option that begins with "--".
// Empty: nothing is wrong so far, and CLI11 looks at the rest.
std::string refuse_words(CLI::App& app, const std::vector<std::string>& words);

// A check for CLI11 of a count: a whole number from 1 on. Returns what is wrong; empty: nothing.
std::string refuse_count(const std::string& text);

}  // namespace passo
