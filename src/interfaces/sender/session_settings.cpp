#include "passo/sender/session_settings.hpp"

#include <fmt/format.h>

#include "passo/sender/grbl_machine_session.hpp"

namespace passo {
namespace {

// grblHAL keeps addresses and passwords there: settings.h of its core.
bool is_of_network(int number) {
  return (number >= 70 && number <= 79) || (number >= 300 && number <= 339);
}

}  // namespace

std::vector<std::pair<int, std::string>> SessionSettings::all() const {
  std::vector<std::pair<int, std::string>> all;
  for (const auto& [number, text] : session_.board().setting_texts) {
    if (!is_of_network(number)) all.emplace_back(number, text);
  }
  return all;
}

void SessionSettings::write(int number, std::string value) {
  if (writer_) return;
  wanted_ = {number, std::move(value)};
  asked_ = session_.now();
}

// The sender is lent when the machine rests and each line is answered.
std::optional<std::string> SessionSettings::begin() {
  GrblSender* const sender = session_.lend_sender();
  if (sender == nullptr) {
    if (session_.now() - asked_ < longest_wait_for_rest) return {};
    return end("The machine does not rest");
  }
  writer_.emplace(*sender);
  writer_->write(fmt::format("${}", wanted_->first), wanted_->second);
  return {};
}

std::optional<std::string> SessionSettings::end(std::string trouble) {
  if (writer_) session_.take_sender_back();
  writer_.reset();
  wanted_.reset();
  return trouble;
}

std::optional<std::string> SessionSettings::poll_write() {
  if (!wanted_) return {};
  if (!writer_) return begin();
  if (!session_.is_sender_lent()) return end("The connection to the board was lost, or the board has restarted");
  writer_->poll();
  if (writer_->busy()) {
    if (session_.now() - asked_ < longest_write) return {};
    return end("The board did not answer in time");
  }
  if (!writer_->trouble().empty()) return end(writer_->trouble());
  const std::vector<SettingChange> changes = writer_->take_changes();
  return end(changes.empty() ? std::string() : changes.back().trouble);
}

}  // namespace passo
