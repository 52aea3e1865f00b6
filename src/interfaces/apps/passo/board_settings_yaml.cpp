#include "board_settings_yaml.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "program_input.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/report/output_file.hpp"
#include "passo/sender/file_upload.hpp"

namespace passo {
namespace {

using nlohmann::ordered_json;

constexpr Seconds longest_yaml_answer{20};
constexpr const char* usual_name = "config.yaml";

bool has_yaml(const BoardSettingsArguments& arguments, const GrblConnection& opened) {
  if (opened.sender().machine().firmware == "FluidNC") return true;
  fail(exit_failed, fmt::format("{}: {} has no YAML file; its settings have numbers [board.no-yaml]", arguments.board,
                                opened.sender().machine().firmware));
  return false;
}

// The lines of an answer without messages.
std::vector<std::string> lines_of(const GrblAnswer& answer) {
  std::vector<std::string> lines = answer.said;
  std::erase_if(lines, [](const std::string& line) { return line.starts_with("[MSG:"); });
  return lines;
}

// As the board shows them: without blanks at the ends of lines, and without empty lines.
std::vector<std::string> shown_lines(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    while (!line.empty() && (line.back() == ' ' || line.back() == '\r' || line.back() == '\t')) line.remove_suffix(1);
    if (!line.empty()) lines.emplace_back(line);
  }
  return lines;
}

// The name of the file that the board reads at its start.
std::optional<std::string> name_of_yaml(GrblConnection& opened, int& code) {
  constexpr std::string_view question = "$Config/Filename";
  const auto answer = opened.ask(std::string(question), longest_yaml_answer, code);
  if (!answer) return {};
  for (const std::string& line : answer->said) {
    if (line.starts_with(question) && line.size() > question.size() + 1) return line.substr(question.size() + 1);
  }
  return usual_name;
}

}  // namespace

bool is_fluidnc_yaml(const std::string& path, const std::string& text) {
  const std::vector<std::string> lines = shown_lines(text);
  const auto tab = std::ranges::find_if(lines, [](const std::string& line) { return line.find('\t') != line.npos; });
  const bool has_axes = std::ranges::find(lines, "axes:") != lines.end();
  if (has_axes && tab == lines.end()) return true;
  fail(exit_bad_program,
       fmt::format(
           "{}: expected a configuration of FluidNC: YAML without tabs, with a line \"axes:\" [settings.bad-yaml]",
           path));
  return false;
}

int show_fluidnc_yaml(const BoardSettingsArguments& arguments, GrblConnection& opened) {
  if (!has_yaml(arguments, opened)) return exit_failed;
  int code = exit_done;
  const auto answer = opened.ask("$CD", longest_yaml_answer, code);
  if (!answer) return code;
  if (!answer->error.empty()) {
    return fail(exit_failed, fmt::format("{}: the board rejects $CD: {}", arguments.board, answer->error));
  }
  std::string text;
  for (const std::string& line : lines_of(*answer)) text += line + "\n";
  if (arguments.json) {
    text = ordered_json{{"yaml", text}}.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
  }
  std::fwrite(text.data(), 1, text.size(), stdout);
  return flush_output();
}

int write_fluidnc_yaml(const BoardSettingsArguments& arguments, GrblConnection& opened, std::string yaml) {
  if (!has_yaml(arguments, opened)) return exit_failed;
  int code = exit_done;
  const auto name = name_of_yaml(opened, code);
  if (!name) return code;
  const std::vector<std::string> wanted = shown_lines(yaml);
  auto sent = FileUpload::begin(opened.sender().machine(), "/localfs/" + *name, std::move(yaml));
  if (!sent) return fail(exit_failed, fmt::format("{}: {}: {} [board.upload]", arguments.board, *name, sent.error()));
  if (!opened.upload(std::move(*sent), code)) return code;
  const auto answer = opened.ask("$LocalFS/Show=/" + *name, longest_yaml_answer, code);
  if (!answer) return code;
  std::string stored;
  for (const std::string& line : lines_of(*answer)) stored += line + "\n";
  if (!answer->error.empty() || shown_lines(stored) != wanted) {
    return fail(
        exit_failed,
        fmt::format("{}: {} on the board is not the file that was sent: send it again before the board restarts "
                    "[board.upload]",
                    arguments.board, *name));
  }
  const std::string text =
      arguments.json
          ? ordered_json{{"written", *name}, {"lines", wanted.size()}, {"needs_restart", true}}.dump(2) + "\n"
          : fmt::format("{} written and read back; it takes effect when the board has restarted\n", *name);
  std::fwrite(text.data(), 1, text.size(), stdout);
  return flush_output();
}

}  // namespace passo
