#include "passo/activity/operator_messages.hpp"

#include <algorithm>

#include "passo/base/utf8.hpp"
#include "passo/interpreter/is_any_of.hpp"

namespace passo {
namespace {

// Without blanks at its ends and without control characters, and not too long.
std::string shown(std::string_view text) {
  const auto is_blank = [](char c) { return static_cast<unsigned char>(c) <= ' '; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  text = cut_at_character(text, OperatorMessages::longest);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  std::string words(text);
  std::ranges::replace_if(
      words, [&](char c) { return is_blank(c) || c == 0x7F; }, ' ');
  return words;
}

}  // namespace

void OperatorMessages::watch(const Operation& operation, const ToolTable& tools) {
  using namespace operation;
  const std::uint32_t line = operation.source.line;
  if (const auto* const message = std::get_if<Message>(&operation.what)) return say(message->text);
  if (const auto* const comment = std::get_if<Comment>(&operation.what)) {
    comment_ = comment->text;
    comment_line_ = line;
  } else if (const auto* const change = std::get_if<ChangeTool>(&operation.what)) {
    const auto remark = tools.remarks.find(change->tool);
    stop(line, remark != tools.remarks.end() ? std::string_view(remark->second) : std::string_view());
  } else if (is_any_of<ProgramStop, OptionalProgramStop>(operation)) {
    stop(line, {});
  } else if (is_any_of<StraightFeed, ArcFeed, NurbsFeed>(operation)) {
    messages_.clear();
  }
}

void OperatorMessages::say(std::string_view text) {
  std::string words = shown(text);
  if (words.empty() || std::ranges::find(messages_, words) != messages_.end()) return;
  if (messages_.size() == most_messages) messages_.erase(messages_.begin());
  messages_.push_back(std::move(words));
}

void OperatorMessages::stop(std::uint32_t line, std::string_view remark) {
  if (comment_line_ == line) say(comment_);
  say(remark);
  if (messages_.empty()) return;
  Stop stop{.line = line, .words = {}};
  for (const std::string& words : messages_) stop.words += (stop.words.empty() ? "" : "\n") + words;
  messages_.clear();
  if (stops_.size() == most_stops) stops_.erase(stops_.begin());
  stops_.push_back(std::move(stop));
}

std::string OperatorMessages::at(std::uint32_t line) const {
  const auto found = std::ranges::find(stops_, line, &Stop::line);
  return found != stops_.end() ? found->words : std::string();
}

void OperatorMessages::pass(std::uint32_t line) {
  const auto found = std::ranges::find(stops_, line, &Stop::line);
  if (found != stops_.end()) stops_.erase(stops_.begin(), found + 1);
}

}  // namespace passo
