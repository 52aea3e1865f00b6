#include "command_documents.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <sstream>
#include <string_view>
#include <vector>

#include "cam_job.hpp"
#include "commands.hpp"
#include "program_input.hpp"
#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace passo {
namespace {

namespace fs = std::filesystem;

struct OptionText {
  std::vector<std::string> names;  // "-m", "--machine"; a positional argument has its name only
  std::string value;               // placeholder of the value, "TEXT"; empty: the option takes none
  std::vector<std::string> choices;
  std::string description;
  bool is_positional = false;
  bool is_required = false;
};

struct CommandText {
  std::string path;  // "passo cam drill"
  std::string purpose;
  std::string footer;
  std::vector<OptionText> options;
  std::vector<std::pair<std::string, std::string>> commands;  // its subcommands: name, purpose
};

// The "mm,inch" of "TEXT:{mm,inch}".
std::vector<std::string> choices_of(const std::string& type) {
  const std::size_t begin = type.find('{');
  const std::size_t end = type.find('}');
  if (begin == std::string::npos || end == std::string::npos) return {};
  return CLI::detail::split(type.substr(begin + 1, end - begin - 1), ',');
}

OptionText text_of(const CLI::Option& option) {
  OptionText text;
  for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
  text.is_positional = text.names.empty();
  if (text.is_positional) text.names.push_back(option.get_name(true));
  const std::string type = option.get_type_name();
  if (option.get_items_expected_max() > 0) text.value = type.substr(0, type.find(':'));
  text.choices = choices_of(type);
  text.description = option.get_description();
  if (!option.get_default_str().empty()) text.description += " (default: " + option.get_default_str() + ")";
  text.is_required = option.get_required();
  return text;
}

void add_texts(const CLI::App& app, const std::string& path, std::vector<CommandText>& texts) {
  CommandText text{
      .path = path, .purpose = app.get_description(), .footer = app.get_footer(), .options = {}, .commands = {}};
  for (const CLI::Option* option : app.get_options()) {
    if (!option->get_group().empty()) text.options.push_back(text_of(*option));
  }
  const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
  for (const CLI::App* command : commands) {
    text.commands.emplace_back(command->get_name(), command->get_description());
  }
  texts.push_back(std::move(text));
  for (const CLI::App* command : commands) add_texts(*command, path + " " + command->get_name(), texts);
}

// --- manual pages

// Text of a manual page: troff reads a dot at the start of a line, a backslash and a hyphen as its own.
std::string in_troff(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n')) {
      out += std::string("\\&") + c;
    } else {
      out += c;
    }
  }
  return out;
}

std::string page_name(std::string path) {
  std::ranges::replace(path, ' ', '-');
  return path;
}

std::string in_bold(const std::string& name) {
  return "\\fB" + in_troff(name) + "\\fR";
}

std::string value_in_troff(const OptionText& option) {
  if (!option.choices.empty()) return "\\fI" + in_troff(fmt::format("{}", fmt::join(option.choices, "|"))) + "\\fR";
  return option.value.empty() ? "" : "\\fI" + in_troff(option.value) + "\\fR";
}

std::string options_in_troff(const CommandText& command, bool positional) {
  std::string out;
  for (const OptionText& option : command.options) {
    if (option.is_positional != positional) continue;
    std::vector<std::string> names;
    for (const std::string& name : option.names) names.push_back(in_bold(name));
    out += fmt::format(".TP\n{}", fmt::join(names, ", "));
    if (!positional && !option.value.empty()) out += " " + value_in_troff(option);
    out += "\n" + in_troff(option.description) + (option.is_required && !positional ? " (required)" : "") + "\n";
  }
  return out;
}

// The text below the options: examples are indented by two spaces; other lines are sentences.
std::string footer_in_troff(const std::string& footer) {
  std::string out;
  bool in_example = false;
  bool has_section = false;
  std::istringstream lines(footer);
  for (std::string line; std::getline(lines, line);) {
    const bool is_example = line.starts_with("  ");
    if (in_example && !is_example) out += ".EE\n";
    if (is_example && !in_example) out += ".PP\n.EX\n";
    in_example = is_example;
    if (line == "Examples:") {
      out += ".SH EXAMPLES\n";
      has_section = true;
    } else if (is_example) {
      out += in_troff(line.substr(2)) + "\n";
    } else if (line.starts_with("Exit codes: ")) {
      out += ".SH \"EXIT STATUS\"\n" + in_troff(line.substr(12)) + "\n";
      has_section = true;
    } else if (!line.empty()) {
      out += (has_section ? ".PP\n" : ".SH NOTES\n") + in_troff(line) + "\n";
      has_section = true;
    }
  }
  return out + (in_example ? ".EE\n" : "");
}

std::string synopsis_in_troff(const CommandText& command) {
  std::string out = in_bold(command.path) + " [\\fIOPTIONS\\fR]";
  for (const OptionText& option : command.options) {
    if (!option.is_positional) continue;
    const std::string name = "\\fI" + in_troff(option.names.front()) + "\\fR";
    out += option.is_required ? " " + name : " [" + name + "]";
  }
  return out + (command.commands.empty() ? "" : " \\fICOMMAND\\fR");
}

std::string manual_page(const CommandText& command, const std::string& version) {
  const std::string name = page_name(command.path);
  std::string title = name;
  std::ranges::transform(title, title.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  std::string sentence = command.purpose;
  if (!sentence.empty())
    sentence.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence.front())));
  if (!sentence.ends_with('.')) sentence += '.';
  const bool is_top = command.path == "passo";
  std::string page = fmt::format(".TH {} 1 \"\" \"Passo {}\" \"Passo\"\n", in_troff(title), version);
  page += fmt::format(".SH NAME\n{} \\- {}\n", in_troff(name),
                      in_troff(is_top ? "motion control for stepper-driven CNC machines" : command.purpose));
  page += ".SH SYNOPSIS\n" + synopsis_in_troff(command) + "\n.SH DESCRIPTION\n" + in_troff(sentence) + "\n";
  if (!command.commands.empty()) page += ".SH COMMANDS\n";
  for (const auto& [subcommand, purpose] : command.commands) {
    page += fmt::format(".TP\n.BR {}\\-{} (1)\n{}\n", in_troff(name), in_troff(subcommand), in_troff(purpose));
  }
  if (const std::string arguments = options_in_troff(command, true); !arguments.empty()) {
    page += ".SH ARGUMENTS\n" + arguments;
  }
  page += ".SH OPTIONS\n" + options_in_troff(command, false) + footer_in_troff(command.footer);
  if (!is_top) {
    const std::string parent = page_name(command.path.substr(0, command.path.rfind(' ')));
    page += fmt::format(".SH \"SEE ALSO\"\n.BR {} (1)\n", in_troff(parent));
  }
  return page;
}

// --- completion

std::string in_quotes(std::string_view text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

// Fish knows \' within quotes.
std::string in_fish_quotes(std::string_view text) {
  std::string out = "'";
  for (const char c : text) out += (c == '\'' || c == '\\' ? "\\" : "") + std::string(1, c);
  return out + "'";
}

// 'passo run'|'passo cam'|…: the paths of all commands but the first.
std::string paths_of(const std::vector<CommandText>& commands, std::string_view between) {
  std::vector<std::string> paths;
  for (const CommandText& command : commands) {
    if (command.path != "passo") paths.push_back(in_quotes(command.path));
  }
  return fmt::format("{}", fmt::join(paths, between));
}

std::vector<std::string> names_of_commands(const CommandText& command) {
  std::vector<std::string> names;
  for (const auto& [name, purpose] : command.commands) names.push_back(name);
  if (command.path == "passo") names.emplace_back("help");
  return names;
}

// A case for each option with a choice: "'passo run --view') choices='auto top' ;;".
std::string choices_by_option(const std::vector<CommandText>& commands) {
  std::string out;
  for (const CommandText& command : commands) {
    for (const OptionText& option : command.options) {
      if (option.choices.empty() || option.is_positional) continue;
      std::vector<std::string> cases;
      for (const std::string& name : option.names) cases.push_back(in_quotes(command.path + " " + name));
      out += fmt::format("    {}) choices='{}' ;;\n", fmt::join(cases, "|"), fmt::join(option.choices, " "));
    }
  }
  return out;
}

std::string bash_completion(const std::vector<CommandText>& commands) {
  std::string words;
  for (const CommandText& command : commands) {
    std::vector<std::string> options;
    for (const OptionText& option : command.options) {
      if (!option.is_positional) options.insert(options.end(), option.names.begin(), option.names.end());
    }
    words += fmt::format("    '{}') commands='{}' options='{}' ;;\n", command.path,
                         fmt::join(names_of_commands(command), " "), fmt::join(options, " "));
  }
  return fmt::format(R"(# bash completion for passo, made by passo itself
_passo() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}} path=passo part
  local commands='' options='' choices=''
  for part in "${{COMP_WORDS[@]:1:COMP_CWORD - 1}}"; do
    case "$path $part" in
    {}) path="$path $part" ;;
    esac
  done
  case "$path $before" in
{}  esac
  case "$path" in
{}  esac
  if [[ -n $choices ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$choices" -- "$word")
  elif [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word")
  elif [[ -n $commands ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$commands" -- "$word")
  else
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
    compopt -o filenames 2>/dev/null
  fi
}}
complete -F _passo passo
)",
                     paths_of(commands, "|"), choices_by_option(commands), words);
}

std::string zsh_completion(const std::vector<CommandText>& commands) {
  std::string words;
  for (const CommandText& command : commands) {
    std::vector<std::string> rows;
    for (const auto& [name, purpose] : command.commands) rows.push_back(in_quotes(fmt::format("{}:{}", name, purpose)));
    std::vector<std::string> options;
    for (const OptionText& option : command.options) {
      if (option.is_positional) continue;
      for (const std::string& name : option.names)
        options.push_back(in_quotes(fmt::format("{}:{}", name, option.description)));
    }
    words += fmt::format("    {})\n      commands=({})\n      options=({})\n      ;;\n", in_quotes(command.path),
                         fmt::join(rows, " "), fmt::join(options, " "));
  }
  return fmt::format(R"(#compdef passo
# zsh completion for passo, made by passo itself
_passo() {{
  local command_path=passo part choices=''
  local -a commands options
  for part in "${{(@)words[2,CURRENT-1]}}"; do
    case "$command_path $part" in
    {}) command_path="$command_path $part" ;;
    esac
  done
  case "$command_path $words[CURRENT-1]" in
{}  esac
  case "$command_path" in
{}  esac
  if [[ -n $choices ]]; then
    compadd -- ${{=choices}}
  elif [[ $words[CURRENT] == -* ]]; then
    _describe -o 'option' options
  elif (( $#commands )); then
    _describe 'command' commands
  else
    _files
  fi
}}
_passo "$@"
)",
                     paths_of(commands, "|"), choices_by_option(commands), words);
}

std::string fish_option(const OptionText& option) {
  std::string out;
  for (const std::string& name : option.names) {
    out += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  if (!option.choices.empty())
    return out + " -x -a " + in_fish_quotes(fmt::format("{}", fmt::join(option.choices, " ")));
  return out + (option.value.empty() ? "" : " -r");
}

std::string fish_completion(const std::vector<CommandText>& commands) {
  std::string out = fmt::format(R"(# fish completion for passo, made by passo itself
function __passo_path
    set -l path passo
    for word in (commandline -opc)[2..-1]
        switch "$path $word"
            case {}
                set path "$path $word"
        end
    end
    echo $path
end
)",
                                paths_of(commands, " "));
  for (const CommandText& command : commands) {
    const std::string here = fmt::format("complete -c passo -n 'test (__passo_path) = \"{}\"'", command.path);
    for (const auto& [name, purpose] : command.commands) {
      out += fmt::format("{} -f -a {} -d {}\n", here, name, in_fish_quotes(purpose));
    }
    for (const OptionText& option : command.options) {
      if (option.is_positional) continue;
      out += fmt::format("{}{} -d {}\n", here, fish_option(option), in_fish_quotes(option.description));
    }
  }
  return out;
}

}  // namespace

int write_command_documents(const CLI::App& app, const std::string& version, const std::string& folder) {
  std::vector<CommandText> commands;
  add_texts(app, "passo", commands);
  const fs::path manual = fs::path(folder) / "man1";
  const fs::path completion = fs::path(folder) / "completion";
  std::map<fs::path, std::string> files = {{completion / "passo", bash_completion(commands)},
                                           {completion / "_passo", zsh_completion(commands)},
                                           {completion / "passo.fish", fish_completion(commands)}};
  for (const CommandText& command : commands) {
    files[manual / (page_name(command.path) + ".1")] = manual_page(command, version);
  }
  for (const fs::path& created : {manual, completion}) {
    std::error_code error;
    fs::create_directories(created, error);
    if (error) return fail(exit_failed, created.string() + ": " + error.message());
  }
  for (const auto& [file, text] : files) {
    if (const int code = write_text(file.string(), text); code != exit_done) return code;
  }
  return exit_done;
}

}  // namespace passo
