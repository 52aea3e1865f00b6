// Options of `passo cam drill`, `isolate` and `outline` that are kept: in a profile, or remembered for a machine in the
// profile beside its file, router.cam.toml beside router.toml.
#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

#include "cam_job.hpp"
#include "cam_options.hpp"
#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "passo/machine_file/option_profile.hpp"
#include "passo/operations/cam_operation.hpp"

namespace passo {
namespace {

using Words = std::vector<std::string>;

// "--tool=0.2" is of "tool".
std::string_view option_of_word(std::string_view word) {
  word.remove_prefix(std::min<std::size_t>(2, word.size()));
  return word.substr(0, word.find('='));
}

// Of an operation's options, or of those that ask for remembered ones.
bool is_kept(std::string_view operation, std::string_view name) {
  const std::vector<CamOption> options = find_cam_operation(operation)->options();
  const CamOption* const option = find_option(options, name);
  return option != nullptr && !option->traits.is_of_job;
}

// Whether what is given takes the place of what is kept: the same option, or another word for it.
bool is_replaced(std::string_view kept, const Words& given) {
  constexpr std::array<std::array<std::string_view, 2>, 4> alternatives{
      {{"tool", "v"}, {"tools", "drill"}, {"passes", "width"}, {"clear", "voronoi"}}};
  return std::ranges::any_of(given, [&](const std::string& word) {
    const std::string_view option = option_of_word(word);
    return option == kept || std::ranges::any_of(alternatives, [&](const auto& pair) {
             return (pair[0] == kept && pair[1] == option) || (pair[1] == kept && pair[0] == option);
           });
  });
}

struct GivenWords {
  Words options;
  Words files;
};
GivenWords words_given(const CLI::App& command) {
  GivenWords given;
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0) continue;
    if (option->get_lnames().empty()) {
      given.files = option->results();
      continue;
    }
    const std::string name = "--" + option->get_lnames().front();
    if (option->get_items_expected_max() == 0) {
      given.options.push_back(name);
      continue;
    }
    for (const std::string& value : option->results()) given.options.push_back(fmt::format("{}={}", name, value));
  }
  return given;
}

// The words as a command line of `section`. Returns an exit code.
int parse_words(CamArguments& all, const std::string& file, const OptionSection& section, const GivenWords& given) {
  Words words = {section.name};
  words.insert(words.end(), section.words.begin(), section.words.end());
  words.insert(words.end(), given.options.begin(), given.options.end());
  words.insert(words.end(), given.files.begin(), given.files.end());
  CLI::App cam;
  CamArguments read;
  CLI::App& command = *cam.add_subcommand(section.name);
  if (section.name == "drill") add_options(command, cam_options_of(read.drill));
  if (section.name == "isolate") add_options(command, cam_options_of(read.isolate));
  if (section.name == "outline") add_options(command, cam_options_of(read.outline));
  add_remember_options(command, read);
  std::ranges::reverse(words);  // CLI11 wants the last word first
  try {
    cam.parse(std::move(words));
  } catch (const CLI::ParseError& error) {
    return fail(exit_bad_program, fmt::format("{}:{}: [{}]: {}", file, section.line, section.name, error.what()));
  }
  for (const std::string& word : section.words) all.of_profile[section.name].emplace_back(option_of_word(word));
  if (section.name == "drill") all.drill = read.drill;
  if (section.name == "isolate") all.isolate = read.isolate;
  if (section.name == "outline") all.outline = read.outline;
  return exit_done;
}

std::string quoted(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

std::string text_of(const std::vector<OptionSection>& sections) {
  std::string text = "# Written by passo cam --remember. The tables are commands, the keys their options.\n";
  for (const OptionSection& section : sections) {
    text += fmt::format("\n[{}]\n", section.name);
    Words done;
    for (const std::string& word : section.words) {
      const std::string option(option_of_word(word));
      if (std::ranges::find(done, option) != done.end()) continue;
      done.push_back(option);
      Words values;
      for (const std::string& other : section.words) {
        if (option_of_word(other) == option && other.find('=') != std::string::npos)
          values.push_back(quoted(std::string_view(other).substr(other.find('=') + 1)));
      }
      text += values.empty()       ? option + " = true\n"
              : values.size() == 1 ? fmt::format("{} = {}\n", option, values.front())
                                   : fmt::format("{} = [{}]\n", option, fmt::join(values, ", "));
    }
  }
  return text;
}

// Empty without a file. Nothing: it is wrong, which was said.
std::optional<std::vector<OptionSection>> sections_of(const std::string& file) {
  Diagnostics findings;
  const auto parts = find_cam_operation("board")->parts;
  auto sections = read_option_profile(file, {parts.begin(), parts.end()}, findings);
  show(findings);
  return sections;
}

// router.cam.toml of router.toml.
std::string remembered_file(const std::string& machine) {
  return std::filesystem::path(machine).replace_extension(".cam.toml").string();
}

}  // namespace

void add_remember_options(CLI::App& command, CamArguments& all) {
  command.add_option("-m,--machine", all.machine,
                     "machine file; options that are not given are read from MACHINE.cam.toml next to it");
  command.add_flag("--remember", all.remember, "save the given options to MACHINE.cam.toml");
}

int use_remembered(const CLI::App& command, CamArguments& all) {
  if (all.machine.empty())
    return all.remember ? fail(exit_bad_program, "--remember needs a machine: -m FILE") : exit_done;
  if (!std::filesystem::exists(all.machine)) return fail(exit_bad_machine, all.machine + ": there is no such file");
  const std::string file = remembered_file(all.machine);
  std::vector<OptionSection> sections;
  if (std::filesystem::exists(file)) {
    auto read = sections_of(file);
    if (!read) return exit_bad_program;
    sections = std::move(*read);
  }
  const std::string name = command.get_name();
  auto section = std::ranges::find(sections, name, &OptionSection::name);
  if (section == sections.end()) section = sections.insert(section, {name, 0, {}});
  const GivenWords given = words_given(command);
  std::erase_if(section->words,
                [&](const std::string& word) { return is_replaced(option_of_word(word), given.options); });
  if (!section->words.empty()) note(fmt::format("{}: {}", file, fmt::join(section->words, " ")));
  const bool is_to_remember = all.remember;
  if (const int code = parse_words(all, file, *section, given); code != exit_done || !is_to_remember) return code;
  for (const std::string& word : given.options) {
    if (is_kept(name, option_of_word(word))) section->words.push_back(word);
  }
  const int code = write_text(file, text_of(sections));
  if (code == exit_done) note("options saved to " + file);
  return code;
}

int read_profile(CamArguments& all) {
  const bool has_machine = !all.board.machine.empty();
  const std::string remembered = has_machine ? remembered_file(all.board.machine) : "";
  std::string file = all.board.profile;
  if (all.board.remember && (file.empty() || !has_machine))
    return fail(exit_bad_program, "--remember also needs --profile FILE and -m FILE");
  if (file.empty() && has_machine && std::filesystem::exists(remembered)) {
    file = remembered;
    note("options from " + file);
  }
  if (file.empty()) return exit_done;
  const auto sections = sections_of(file);
  if (!sections) return exit_bad_program;
  for (const OptionSection& section : *sections) {
    if (const int code = parse_words(all, file, section, {{}, {"board"}}); code != exit_done) return code;
  }
  if (!all.board.remember) return exit_done;
  const int code = write_text(remembered, text_of(*sections));
  if (code == exit_done) note("options saved to " + remembered);
  return code;
}

}  // namespace passo
