// passo board settings: shows, writes, saves, compares and restores the settings of a Grbl board.
#include "board_settings.hpp"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>
#include <utility>
#include <vector>

#include "board_settings_yaml.hpp"
#include "commands.hpp"
#include "grbl_connection.hpp"
#include "named_files.hpp"
#include "program_input.hpp"
#include "run_signals.hpp"
#include "setting_words.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/base/counted.hpp"
#include "passo/diagnostics/file_bytes.hpp"
#include "passo/report/output_file.hpp"
#include "passo/sender/firmware_settings.hpp"

namespace passo {
namespace {

using nlohmann::ordered_json;
using Kind = FirmwareSetting::Kind;

constexpr std::size_t most_bytes = 1 << 20;
constexpr Seconds longest_dump{20};

std::string dollar_name(const std::string& name) {
  return name.starts_with('$') ? name : "$" + name;
}

// "0: X Y, 1: Z" …: what the bits of the value, or the value, mean.
std::string choice_words(const FirmwareSetting& setting) {
  std::string words;
  const auto value = read_grbl_number(setting.value).value_or(-1);
  for (std::size_t i = 0; i < setting.choices.size(); ++i) {
    const bool is_sum = setting.kind == Kind::bits || setting.kind == Kind::axes;
    const bool is_on = is_sum ? value >= 0 && value < 65536 && (static_cast<unsigned>(value) >> i & 1U) != 0
                              : value == static_cast<double>(i);
    if (is_on && !setting.choices[i].empty()) words += (words.empty() ? "" : ", ") + setting.choices[i];
  }
  return words;
}

std::string line_of(const FirmwareSetting& setting) {
  const std::string choice = choice_words(setting);
  return fmt::format("{:<6} {:>12}  {:<10} {}{}\n", setting.name, setting.value, setting.unit, setting.title,
                     choice.empty() ? "" : ": " + choice);
}

std::string details_of(const FirmwareSetting& setting) {
  std::string text = line_of(setting);
  const auto add = [&](const std::string& words) { text += fmt::format("{:<22}{}\n", "", words); };
  if (!setting.meaning.empty()) add(setting.meaning);
  if (setting.least || setting.most) {
    const std::string least = setting.least ? fmt::format("from {:g}", *setting.least) : "";
    const std::string most = setting.most ? fmt::format("up to {:g}", *setting.most) : "";
    add(least + (least.empty() || most.empty() ? "" : " ") + most + (setting.zero_too ? ", or 0" : ""));
  }
  const bool is_sum = setting.kind == Kind::bits || setting.kind == Kind::axes;
  for (std::size_t i = 0; i < setting.choices.size() && i < 16; ++i) {
    if (!setting.choices[i].empty()) add(fmt::format("{}: {}", is_sum ? 1U << i : i, setting.choices[i]));
  }
  if (setting.needs_restart) add("takes effect when the board has restarted");
  if (setting.read_only) add("in the board's YAML file; cannot be written by its number");
  return text;
}

// What the command does with one board.
class SettingsRun {
 public:
  SettingsRun(const BoardSettingsArguments& arguments, GrblConnection& opened)
      : arguments_(arguments), opened_(opened), settings_(opened.sender()) {}

  int run(const std::vector<NamedSetting>& file);

 private:
  // False, with a message: the settings could not be read, or Ctrl-C.
  bool finish();
  bool knows_names() const;
  void write(const std::vector<NamedSetting>& file);
  int print(const std::vector<NamedSetting>& file);
  bool save() const;

  const BoardSettingsArguments& arguments_;
  GrblConnection& opened_;
  FirmwareSettings settings_;
  std::vector<SettingChange> changes_;
  int code_ = exit_done;
};

bool SettingsRun::finish() {
  while (settings_.busy() && interrupted_by() == 0) {
    opened_.poll(GrblConnection::between_looks);
    settings_.poll();
  }
  for (SettingChange& change : settings_.take_changes()) changes_.push_back(std::move(change));
  if (interrupted_by() != 0) {
    code_ = exit_of_signal();
  } else if (!settings_.trouble().empty()) {
    code_ = fail(exit_failed, fmt::format("{}: {}", arguments_.board, settings_.trouble()));
  }
  return code_ == exit_done;
}

bool SettingsRun::knows_names() const {
  for (const std::string& name : arguments_.names) {
    if (settings_.find(name) != nullptr) continue;
    fail(exit_bad_program, fmt::format("{}: the board has no setting {}", arguments_.board, dollar_name(name)));
    return false;
  }
  return true;
}

void SettingsRun::write(const std::vector<NamedSetting>& file) {
  for (const std::string& one : arguments_.set) {
    const std::size_t equals = one.find('=');
    settings_.write(one.substr(0, equals), one.substr(equals + 1));
  }
  if (arguments_.restore.empty()) return;
  for (const SettingDifference& one : differences(file, settings_.all())) {
    if (!one.in_file.empty() && !one.on_board.empty()) settings_.write(one.name, one.in_file);
    if (one.on_board.empty()) note(fmt::format("{}: the board has no setting {}", arguments_.restore, one.name));
  }
}

bool SettingsRun::save() const {
  if (arguments_.save.empty()) return true;
  auto out = OutputFile::open(arguments_.save);
  if (out) out->write(settings_text(opened_.sender().machine(), settings_.all()));
  const auto done = out ? out->commit() : Status<OutputError>(Failure{out.error()});
  if (!done) fail(exit_failed, done.error().message);
  return done.has_value();
}

int SettingsRun::print(const std::vector<NamedSetting>& file) {
  const GrblMachine& machine = opened_.sender().machine();
  const auto different =
      arguments_.compare.empty() ? std::vector<SettingDifference>() : differences(file, settings_.all());
  std::string text;
  ordered_json json = {{"firmware", machine.firmware}, {"version", machine.version}, {"axes", machine.axes}};
  json["settings"] = ordered_json::array();
  const bool shows_all = arguments_.names.empty();
  const bool only_shows =
      arguments_.set.empty() && arguments_.compare.empty() && arguments_.restore.empty() && arguments_.save.empty();
  for (const FirmwareSetting& setting : settings_.all()) {
    const auto is_it = [&](const std::string& name) { return dollar_name(name) == setting.name; };
    if (!shows_all && std::ranges::none_of(arguments_.names, is_it)) continue;
    json["settings"].push_back(to_json(setting));
    if (only_shows || !shows_all) text += shows_all ? line_of(setting) : details_of(setting);
  }
  json["changes"] = ordered_json::array();
  for (const SettingChange& change : changes_) {
    json["changes"].push_back(to_json(change));
    if (!change.trouble.empty()) {
      if (!arguments_.json) fail(exit_failed, fmt::format("{}: {}", arguments_.board, change.trouble));
      code_ = exit_failed;
      continue;
    }
    text += fmt::format("{}: {} -> {}\n", change.name, change.before, change.after);
    for (const std::string& also : change.also) text += fmt::format("  the board has also changed {}\n", also);
  }
  if (!arguments_.restore.empty() && changes_.empty()) text += "no setting differs\n";
  if (settings_.needs_restart() && !arguments_.json)
    note("some of these settings take effect when the board has restarted");
  if (!arguments_.compare.empty()) {
    json["differences"] = ordered_json::array();
    for (const SettingDifference& one : different) {
      json["differences"].push_back(to_json(one));
      const auto shown = [](const std::string& value) { return value.empty() ? std::string("-") : value; };
      text += fmt::format("{}: {} in the file, {} on the board\n", one.name, shown(one.in_file), shown(one.on_board));
    }
    if (different.empty()) text += "no setting differs\n";
    if (!different.empty()) code_ = exit_failed;
  }
  const std::string all =
      arguments_.json ? json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n" : text;
  std::fwrite(all.data(), 1, all.size(), stdout);
  const int printed = flush_output();
  return printed == exit_done ? code_ : printed;
}

int SettingsRun::run(const std::vector<NamedSetting>& file) {
  settings_.read();
  if (!finish()) return code_;
  if (!knows_names()) return exit_bad_program;
  write(file);
  if (!finish()) return code_;
  if (!save()) return exit_failed;
  return print(file);
}

// Empty, with a message: the file cannot be read, or has no settings.
std::optional<std::vector<NamedSetting>> read_settings_file(const std::string& path) {
  Diagnostics diagnostics;
  const auto text = read_bytes(
      path, {.area = "settings", .expected = "a file of settings, such as $110=500", .most = most_bytes}, diagnostics);
  show(diagnostics);
  if (!text) return std::nullopt;
  auto settings = parse_settings_text(*text);
  if (settings) return std::move(*settings);
  fail(exit_bad_program, fmt::format("{}: {} [settings.bad-file]", path, settings.error()));
  return std::nullopt;
}

// Empty, with a message: the file cannot be read, or is no configuration of FluidNC.
std::optional<std::string> read_yaml_file(const std::string& path) {
  Diagnostics diagnostics;
  auto text =
      read_bytes(path, {.area = "settings", .expected = "a YAML file of FluidNC", .most = most_bytes}, diagnostics);
  show(diagnostics);
  if (!text || !is_fluidnc_yaml(path, *text)) return std::nullopt;
  return text;
}

// Replaces "-" among the values by the lines of standard input. False, with a message: there are too many.
bool read_given_values(std::vector<std::string>& values) {
  const auto given = std::ranges::find(values, "-");
  if (given == values.end()) return true;
  values.erase(given);
  std::string line;
  std::size_t bytes = 0;
  while (std::getline(std::cin, line)) {
    bytes += line.size();
    if (bytes > most_bytes) {
      fail(exit_bad_program, fmt::format("--set -: expected at most {} bytes [settings.bad-file]", most_bytes));
      return false;
    }
    if (line.ends_with('\r')) line.pop_back();
    if (!line.empty()) values.push_back(line);
  }
  return true;
}

bool are_good(const BoardSettingsArguments& arguments) {
  if (!names_grbl_machine(arguments.board)) {
    fail(exit_bad_program, arguments.board +
                               ": only Grbl boards have such settings: expected grbl:DEVICE[@BAUD], "
                               "grbl:tcp:HOST:PORT or grbl:ws://HOST [board.not-grbl]");
    return false;
  }
  for (const std::string& one : arguments.set) {
    const std::size_t equals = one.find('=');
    if (equals != std::string::npos && equals > 0) continue;
    fail(exit_bad_program, fmt::format("--set {}: expected NAME=VALUE, e.g. 110=500", one));
    return false;
  }
  NamedFiles files;
  files.reads("--compare", arguments.compare);
  files.reads("--restore", arguments.restore);
  files.writes("--save", arguments.save);
  return files.are_apart();
}

}  // namespace

int board_settings(const BoardSettingsArguments& given) {
  BoardSettingsArguments arguments = given;
  if (!read_given_values(arguments.set) || !are_good(arguments)) return exit_bad_program;
  std::string yaml;
  if (!arguments.write_config.empty()) {
    auto read = read_yaml_file(arguments.write_config);
    if (!read) return exit_bad_program;
    yaml = std::move(*read);
  }
  const std::string& path = arguments.compare.empty() ? arguments.restore : arguments.compare;
  std::vector<NamedSetting> file;
  if (!path.empty()) {
    auto read = read_settings_file(path);
    if (!read) return exit_bad_program;
    file = std::move(*read);
  }
  int code = exit_done;
  brake_on_signals();
  const auto opened = GrblConnection::open(arguments.board, code);
  if (!opened) return code;
  if (arguments.config) return show_fluidnc_yaml(arguments, *opened);
  if (!yaml.empty()) return write_fluidnc_yaml(arguments, *opened, std::move(yaml));
  return SettingsRun(arguments, *opened).run(file);
}

std::optional<std::string> controller_text_of(const std::string& board, int& code) {
  brake_on_signals();
  const auto opened = GrblConnection::open(board, code);
  if (!opened) return std::nullopt;
  GrblSender& sender = opened->sender();
  const auto failed = [&](const std::string& words) {
    code = interrupted_by() != 0 ? exit_of_signal() : fail(exit_failed, fmt::format("{}: {}", board, words));
    return std::nullopt;
  };
  if (sender.machine().row().settings != GrblFirmware::Settings::yaml) {
    FirmwareSettings settings(sender);
    settings.read();
    while (settings.busy() && interrupted_by() == 0) {
      opened->poll(GrblConnection::between_looks);
      settings.poll();
    }
    if (interrupted_by() != 0 || !settings.trouble().empty()) return failed(settings.trouble());
    return settings_text(sender.machine(), settings.all());
  }
  sender.ask("$CD", longest_dump);
  std::optional<GrblAnswer> answer;
  while (!answer && !sender.fault() && interrupted_by() == 0) {
    opened->poll(GrblConnection::between_looks);
    answer = sender.take_reply();
  }
  if (!answer) return failed(sender.fault() ? sender.fault()->message : "");
  if (!answer->error.empty()) return failed("the board rejects $CD: " + answer->error);
  std::string yaml;
  for (const std::string& line : answer->said) {
    if (!line.starts_with("[MSG:")) yaml += line + "\n";
  }
  return yaml;
}

}  // namespace passo
