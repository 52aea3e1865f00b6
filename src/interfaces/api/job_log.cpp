#include "job_log.hpp"

#include <utility>
#include <variant>

namespace passo {

void JobLog::record(const Operation& operation) {
  if (all_.size() >= most_words) return;
  const auto note = [&](std::string_view kind, std::string_view text) {
    all_.push_back({.kind = kind, .line = operation.source.line, .text = std::string(text.substr(0, longest_words))});
  };
  if (const auto* print = std::get_if<operation::Print>(&operation.what)) note("print", print->text);
  if (const auto* message = std::get_if<operation::Message>(&operation.what)) note("message", message->text);
  const auto* log = std::get_if<operation::Log>(&operation.what);
  if (log != nullptr && log->kind == operation::Log::Kind::line) note("log", log->text);
}

std::string JobLog::lines() const {
  std::string text;
  for (const Words& words : all_) {
    if (words.kind == "log") text += words.text + "\n";
  }
  return text;
}

Json JobLog::json() const {
  Json list = Json::array();
  for (const Words& words : all_) {
    list.push_back({{"kind", words.kind}, {"line", words.line}, {"text", words.text}});
  }
  return list;
}

}  // namespace passo
