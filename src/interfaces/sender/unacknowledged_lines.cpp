#include "passo/sender/unacknowledged_lines.hpp"

#include <utility>

namespace passo {
namespace {

constexpr std::size_t most_said = 5000;   // lines of one answer
constexpr std::size_t least_buffer = 64;  // fewer free bytes are hardly a whole buffer

// The chip of a Grbl board takes no byte while it writes its EEPROM, so what follows such a line would be lost.
bool writes_eeprom(std::string_view line) {
  const bool is_setting = line.size() > 1 && line[0] == '$' && ((line[1] >= '0' && line[1] <= '9') || line[1] == 'N');
  const auto has = [line](std::string_view word) { return line.find(word) != std::string_view::npos; };
  return is_setting || has("G10L") || has("G28.1") || has("G30.1");
}

}  // namespace

std::string UnacknowledgedLines::send(Seconds now, std::size_t size) {
  std::string bytes;
  while (next_fitting(size) != nullptr) bytes += send_next(now);
  return bytes;
}

const UnacknowledgedLines::Line* UnacknowledgedLines::next_fitting(std::size_t size) const {
  if (!sent_.empty() && writes_eeprom(sent_.back().text)) return nullptr;
  const bool fits = !waiting_.empty() && sent_bytes_ + waiting_.front().text.size() <= usable(size);
  return fits ? &waiting_.front() : nullptr;
}

std::string UnacknowledgedLines::send_next(Seconds now) {
  Line& next = waiting_.front();
  next.sent = now;
  std::string bytes = next.text;
  sent_bytes_ += bytes.size();
  if (next.line != 0) last_line_ = next.line;
  if (!next.goes_on) ++lines_sent_;
  sent_.push_back(std::move(next));
  waiting_.pop_front();
  return bytes;
}

bool UnacknowledgedLines::send_mark(const std::string& text, Seconds now, std::size_t size) {
  if (!sent_.empty() && writes_eeprom(sent_.back().text)) return false;
  if (sent_bytes_ + text.size() > usable(size)) return false;
  sent_.push_back({.text = text, .sent = now, .marks = true});
  sent_bytes_ += text.size();
  return true;
}

std::optional<UnacknowledgedLines::Line> UnacknowledgedLines::take_answered() {
  if (sent_.empty()) return {};
  Line line = std::move(sent_.front());
  sent_.pop_front();
  sent_bytes_ -= line.text.size();
  if (!line.goes_on && !line.marks) ++lines_answered_;
  return line;
}

void UnacknowledgedLines::note_said(std::string_view text) {
  if (sent_.empty() || !sent_.front().asks || sent_.front().said.size() >= most_said) return;
  sent_.front().said.emplace_back(text);
}

void UnacknowledgedLines::keep_reply(Line line, std::string error) {
  if (line.text.ends_with('\n')) line.text.pop_back();
  replies_.push_back({.line = std::move(line.text), .said = std::move(line.said), .error = std::move(error)});
}

std::optional<GrblAnswer> UnacknowledgedLines::take_reply() {
  if (replies_.empty()) return {};
  GrblAnswer reply = std::move(replies_.front());
  replies_.pop_front();
  return reply;
}

void UnacknowledgedLines::hear_free_bytes(std::size_t bytes) {
  if (sent_.empty() && bytes >= least_buffer) empty_buffer_ = bytes;
}

void UnacknowledgedLines::note_held(std::uint32_t line, std::size_t most) {
  if (line != 0) held_.push_back(line);
  if (held_.size() > most) held_.pop_front();
}

std::uint32_t UnacknowledgedLines::first_held(std::size_t count) const {
  count = std::min(count, held_.size());
  return count == 0 ? last_line_ : held_[held_.size() - count];
}

}  // namespace passo
