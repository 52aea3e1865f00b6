#include "served_settings.hpp"

#include <utility>

#include "setting_words.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

namespace passo {
namespace {

constexpr const char* given_file = "given.txt";
constexpr const char* saved_file = "saved.txt";

std::string report_of(const GrblMachine& machine, const FirmwareSettings& settings,
                      const std::vector<SettingChange>& changes,
                      const std::optional<std::vector<SettingDifference>>& differences) {
  nlohmann::ordered_json json = {{"firmware", machine.firmware}, {"version", machine.version}, {"axes", machine.axes}};
  json["settings"] = nlohmann::ordered_json::array();
  for (const FirmwareSetting& setting : settings.all()) json["settings"].push_back(to_json(setting));
  json["changes"] = nlohmann::ordered_json::array();
  for (const SettingChange& change : changes) json["changes"].push_back(to_json(change));
  if (differences) {
    json["differences"] = nlohmann::ordered_json::array();
    for (const SettingDifference& one : *differences) json["differences"].push_back(to_json(one));
  }
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace

bool ServedSettings::has_board() const {
  return live_ != nullptr || contact_.result().state == ContactResult::State::done;
}

bool ServedSettings::begin(const SettingsOrder& order) {
  if (result().state == SettingsResult::State::running) return false;
  return live_ != nullptr ? begin_live(order) : begin_process(order);
}

void ServedSettings::fail(std::string words) {
  result_.state = SettingsResult::State::failed;
  result_.words = std::move(words);
}

bool ServedSettings::begin_process(const SettingsOrder& order) {
  using Kind = SettingsOrder::Kind;
  const std::string board = contact_.result().board;
  folder_.remove();
  if (board.empty() || !folder_.make()) return false;
  std::vector<std::string> words{"passo", "board", "settings", board, "--json", "--save", saved_file};
  // Values may be passwords, and everybody on the computer can read the words.
  std::string values;
  for (const auto& [name, value] : order.values) values += name + "=" + value + "\n";
  if (!values.empty()) words.insert(words.end(), {"--set", "-"});
  if (order.kind == Kind::compare || order.kind == Kind::restore) {
    if (!write_content(folder_.path(given_file), order.file)) return false;
    words.insert(words.end(), {order.kind == Kind::compare ? "--compare" : "--restore", given_file});
  }
  if (!process_.begin(folder_.name(), words, values)) return false;
  begun_ = Clock::now();
  result_ = {.state = SettingsResult::State::running, .board = board};
  return true;
}

bool ServedSettings::begin_live(const SettingsOrder& order) {
  std::vector<NamedSetting> wanted;
  if (!order.file.empty()) {
    auto file = parse_settings_text(order.file);
    if (!file) {
      result_ = {.board = contact_.board()};
      fail(file.error());
      return true;
    }
    wanted = std::move(*file);
  }
  GrblSender* const sender = live_->lend_sender();
  if (sender == nullptr) return false;
  settings_.emplace(*sender);
  settings_->read();
  order_ = order;
  wanted_ = std::move(wanted);
  was_read_ = false;
  begun_ = Clock::now();
  result_ = {.state = SettingsResult::State::running, .board = contact_.board()};
  return true;
}

void ServedSettings::end_live(std::string trouble) {
  const std::vector<SettingChange> changes = settings_->take_changes();
  const GrblMachine& machine = live_->board();
  live_->take_sender_back();
  if (!settings_->all().empty()) {
    std::optional<std::vector<SettingDifference>> different;
    if (order_.kind == SettingsOrder::Kind::compare) different = differences(wanted_, settings_->all());
    result_.report = report_of(machine, *settings_, changes, different);
    result_.file = settings_text(machine, settings_->all());
  }
  result_.state = SettingsResult::State::done;
  if (!trouble.empty()) fail(std::move(trouble));
  settings_.reset();
}

void ServedSettings::poll() {
  if (!settings_) return;
  if (!live_->is_sender_lent()) return end_live("the connection to the board was lost, or the board has restarted");
  settings_->poll();
  if (settings_->busy()) {
    if (Clock::now() - begun_ > longest_order) end_live("the board did not answer in time");
    return;
  }
  if (!settings_->trouble().empty()) return end_live(settings_->trouble());
  if (std::exchange(was_read_, true)) return end_live("");
  for (const auto& [name, value] : order_.values) settings_->write(name, value);
  if (order_.kind == SettingsOrder::Kind::restore) {
    for (const SettingDifference& one : differences(wanted_, settings_->all())) {
      if (!one.in_file.empty() && !one.on_board.empty()) settings_->write(one.name, one.in_file);
    }
  }
}

const SettingsResult& ServedSettings::result() {
  if (live_ != nullptr || result_.state != SettingsResult::State::running) return result_;
  const std::optional<int> end = process_.poll();
  if (!end) {
    if (Clock::now() - begun_ < longest_order) return result_;
    process_.end();
    fail("the board did not answer in time");
    return result_;
  }
  result_.words = content_of(folder_.path(BackgroundProcess::said_file)).substr(0, BackgroundProcess::longest_words);
  result_.report = content_of(folder_.path(BackgroundProcess::printed_file));
  result_.file = content_of(folder_.path(saved_file));
  // 1: a change was refused, or settings differ; the report tells it.
  const bool good = WIFEXITED(*end) && WEXITSTATUS(*end) <= 1 && result_.report.starts_with("{");
  result_.state = good ? SettingsResult::State::done : SettingsResult::State::failed;
  if (!good && result_.words.empty()) result_.words = words_of_end(*end);
  return result_;
}

}  // namespace passo
