#include "command_words.hpp"

#include <algorithm>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {
namespace {

// " (did you mean run?)", or nothing.
std::string guess(std::string_view word, const std::vector<std::string>& known, std::string_view before = "") {
  const std::vector<std::string_view> names(known.begin(), known.end());
  const std::string_view meant = suggestion(word, names);
  return meant.empty() ? std::string() : fmt::format(" (did you mean {}{}?)", before, meant);
}

std::vector<std::string> commands_of(CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> long_options_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    names.insert(names.end(), option->get_lnames().begin(), option->get_lnames().end());
  }
  return names;
}

std::string refuse_option(const CLI::App& command, std::string_view word) {
  const std::string name(word.substr(2, word.find('=') - 2));
  const std::vector<std::string> known = long_options_of(command);
  if (std::ranges::find(known, name) != known.end()) return {};
  const std::string path = command.get_parent() == nullptr ? "passo"
                           : command.get_parent()->get_parent() == nullptr
                               ? "passo " + command.get_name()
                               : "passo " + command.get_parent()->get_name() + " " + command.get_name();
  return fmt::format("{} has no option --{}{}; {} --help lists the options", path, name, guess(name, known, "--"),
                     path);
}

}  // namespace

std::vector<std::string> command_words(int argc, const char* const* argv) {
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  // CLI11 would take "-:12", a line of standard input, for an option. What follows "--" is no option.
  const auto place = std::ranges::find_if(words, [](const std::string& word) { return word.starts_with("-:"); });
  if (place != words.end()) {
    std::rotate(place, place + 1, words.end());
    words.insert(words.end() - 1, "--");
  }
  if (words.empty() || words.front() != "help") return words;
  words.erase(words.begin());
  words.emplace_back("--help");
  return words;
}

std::string refuse_words(CLI::App& app, const std::vector<std::string>& words) {
  CLI::App* command = &app;
  for (const std::string& word : words) {
    if (word == "--") break;
    if (word.starts_with("--")) {
      if (std::string words_of_refusal = refuse_option(*command, word); !words_of_refusal.empty()) {
        return words_of_refusal;
      }
      continue;
    }
    const std::vector<std::string> commands = commands_of(*command);
    if (commands.empty() || word.starts_with('-')) continue;
    if (std::ranges::find(commands, word) == commands.end()) {
      const std::string path = command == &app ? "passo" : "passo " + command->get_name();
      return fmt::format("{} has no command {}{}; {} --help lists the commands", path, word, guess(word, commands),
                         path);
    }
    command = command->get_subcommand(word);
  }
  return {};
}

std::string refuse_count(const std::string& text) {
  const bool is_number = !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
  const bool is_zero = text.find_first_not_of('0') == std::string::npos;
  constexpr std::size_t most_digits = 18;
  return is_number && !is_zero && text.size() <= most_digits
             ? std::string()
             : fmt::format("{}: expected a whole number of 1 or more", text);
}

}  // namespace passo
