#include "passo/sender/firmware_settings.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace passo {
namespace {

// grblHAL on a slow line takes seconds to describe its settings.
constexpr Seconds longest_answer{20};
constexpr std::string_view all_settings = "$$";

std::string with_dollar(std::string_view name) {
  return name.starts_with('$') ? std::string(name) : fmt::format("${}", name);
}

}  // namespace

void FirmwareSettings::read() {
  if (stage_ == Stage::idle) ask_for_settings(Stage::reading);
}

void FirmwareSettings::write(std::string_view name, std::string_view value) {
  wanted_.push_back(
      {.name = with_dollar(name), .before = "", .wanted = std::string(value), .after = "", .trouble = ""});
  if (stage_ != Stage::idle) return;
  if (settings_.empty()) return read();
  begin_next();
}

const FirmwareSetting* FirmwareSettings::find(std::string_view name) const {
  const auto found = std::ranges::find(settings_, with_dollar(name), &FirmwareSetting::name);
  return found == settings_.end() ? nullptr : &*found;
}

std::vector<SettingChange> FirmwareSettings::take_changes() {
  return std::exchange(done_, {});
}

void FirmwareSettings::ask_for_settings(Stage stage) {
  stage_ = stage;
  trouble_.clear();
  if (!std::exchange(was_described_, true) && sender_.machine().row().settings == GrblFirmware::Settings::described) {
    for (const char* question : {"$EG", "$ES", "$ESH"}) sender_.ask(question, longest_answer);
  }
  sender_.ask(std::string(all_settings), longest_answer);
}

void FirmwareSettings::poll() {
  while (stage_ != Stage::idle) {
    const auto answer = sender_.take_reply();
    if (!answer) break;
    take(*answer);
  }
  if (stage_ == Stage::idle || !sender_.fault()) return;
  end_all(sender_.fault()->message);
}

void FirmwareSettings::take(const GrblAnswer& answer) {
  if (answer.line.starts_with("$E")) {
    for (const std::string& line : answer.said) descriptions_.hear(line);
    return;
  }
  switch (stage_) {
    case Stage::idle: return;
    case Stage::writing:
      if (answer.error.empty()) return ask_for_settings(Stage::reading_back);
      end_change(fmt::format("the board rejects {}={}: {}", wanted_.front().name, shown_of_wanted(), answer.error));
      return begin_next();
    case Stage::undoing: return ask_for_settings(Stage::reading_old);
    case Stage::saving:
      stage_ = Stage::idle;  // a board without this command has saved them at once
      return begin_next();
    case Stage::reading:
    case Stage::reading_back:
    case Stage::reading_old: break;
  }
  if (!answer.error.empty()) return end_all(fmt::format("the board rejects {}: {}", answer.line, answer.error));
  take_settings(answer);
  if (stage_ == Stage::reading) {
    if (settings_.empty()) return end_all("the board has told no settings");
    stage_ = Stage::idle;
    return begin_next();
  }
  take_read_back();
}

void FirmwareSettings::take_settings(const GrblAnswer& answer) {
  const GrblMachine& machine = sender_.machine();
  const bool is_yaml = machine.row().settings == GrblFirmware::Settings::yaml;
  settings_.clear();
  for (const std::string& line : answer.said) {
    const std::size_t equals = line.find('=');
    if (!line.starts_with('$') || equals == std::string::npos || equals < 2) continue;
    FirmwareSetting setting{.name = line.substr(0, equals), .value = line.substr(equals + 1)};
    if (!descriptions_.describe(setting, machine.axes)) describe_by_table(setting, machine.axes);
    if (setting.kind == FirmwareSetting::Kind::unknown && names_password(setting.name)) {
      setting.kind = FirmwareSetting::Kind::password;
    }
    setting.value = shown_value(setting, setting.value);
    // FluidNC stores the content of reports, and settings with names; the other numbers show what its YAML file says.
    setting.read_only = is_yaml && setting.name != "$10" && read_setting_number(setting.name);
    settings_.push_back(std::move(setting));
  }
}

void FirmwareSettings::take_read_back() {
  SettingChange& change = wanted_.front();
  const FirmwareSetting* const now = find(change.name);
  change.after = now == nullptr ? "" : now->value;
  if (stage_ == Stage::reading_old) {
    const bool is_old = is_same_value(change.after, change.before);
    end_change(fmt::format("the board did not take the value {}={}; {} is {} {}", change.name, shown_of_wanted(),
                           change.name, change.after,
                           is_old ? "again" : "now, and the old value could not be restored"));
    return begin_next();
  }
  // A password is not shown.
  const bool is_hidden = now != nullptr && now->kind == FirmwareSetting::Kind::password;
  if (!is_hidden && !is_same_value(change.after, change.wanted)) {
    stage_ = Stage::undoing;
    return sender_.ask(fmt::format("{}={}", change.name, change.before), longest_answer);
  }
  needs_restart_ = needs_restart_ || (now != nullptr && now->needs_restart);
  is_unsaved_ = true;
  for (const FirmwareSetting& old : before_) {
    const FirmwareSetting* const other = find(old.name);
    if (old.name == change.name || other == nullptr || is_same_value(old.value, other->value)) continue;
    change.also.push_back(fmt::format("{}: {} -> {}", old.name, old.value, other->value));
  }
  end_change("");
  begin_next();
}

// The wanted value for people.
std::string FirmwareSettings::shown_of_wanted() const {
  const SettingChange& change = wanted_.front();
  FirmwareSetting setting{.name = change.name, .value = {}};
  if (const FirmwareSetting* const known = find(change.name)) setting = *known;
  if (names_password(change.name)) setting.kind = FirmwareSetting::Kind::password;
  return shown_value(setting, change.wanted);
}

void FirmwareSettings::end_change(std::string trouble) {
  std::string shown = shown_of_wanted();
  SettingChange change = std::move(wanted_.front());
  change.wanted = std::move(shown);
  wanted_.pop_front();
  if (!trouble.empty() && change.after.empty()) change.after = change.before;
  change.trouble = std::move(trouble);
  done_.push_back(std::move(change));
}

void FirmwareSettings::end_all(const std::string& trouble) {
  trouble_ = trouble;
  while (!wanted_.empty()) end_change(trouble);
  stage_ = Stage::idle;
}

void FirmwareSettings::begin_next() {
  stage_ = Stage::idle;
  while (!wanted_.empty()) {
    SettingChange& change = wanted_.front();
    const FirmwareSetting* const setting = find(change.name);
    if (setting == nullptr) {
      end_change(fmt::format("the board has no setting {}", change.name));
      continue;
    }
    change.before = setting->value;
    if (const auto good = check_setting(*setting, change.wanted); !good) {
      end_change(good.error());
      continue;
    }
    before_ = settings_;
    stage_ = Stage::writing;
    return sender_.ask(fmt::format("{}={}", change.name, change.wanted), longest_answer);
  }
  const std::string_view save = sender_.machine().row().save;
  if (!std::exchange(is_unsaved_, false) || save.empty()) return;
  stage_ = Stage::saving;
  sender_.ask(std::string(save), longest_answer);
}

}  // namespace passo
