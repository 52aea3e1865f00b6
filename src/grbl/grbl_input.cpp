#include "passo/grbl/grbl_input.hpp"

#include <algorithm>

namespace passo {
namespace {

constexpr std::uint8_t first_high = 0x80;

bool is_low_command(std::uint8_t byte) {
  return byte == '?' || byte == '!' || byte == '~' || byte == 0x18;
}

bool ends_line(char c) {
  return c == '\n' || c == '\r';
}

char capital(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

// How many bytes follow a byte that begins a character of UTF-8.
int following(std::uint8_t byte) {
  if (byte >= 0xF0) return 3;
  if (byte >= 0xE0) return 2;
  return byte >= 0xC0 ? 1 : 0;
}

}  // namespace

std::optional<std::uint8_t> GrblInput::command(std::uint8_t byte) {
  if (byte < first_high) {
    text_bytes_ = 0;
    command_next_ = false;
    return is_low_command(byte) ? std::optional(byte) : std::nullopt;
  }
  const bool continues = byte < 0xC0;
  if (!continues) {
    text_bytes_ = following(byte);
    command_next_ = byte == 0xC2;
    return {};
  }
  const bool is_text = text_bytes_ > 0 && !command_next_;
  if (text_bytes_ > 0) --text_bytes_;
  command_next_ = false;
  return is_text ? std::nullopt : std::optional(byte);
}

void GrblInput::receive(std::string_view bytes, const std::function<void(std::uint8_t)>& act) {
  for (const char c : bytes) {
    const auto byte = static_cast<std::uint8_t>(c);
    if (const auto found = command(byte)) {
      act(*found);
      continue;
    }
    if (byte >= first_high) continue;  // text that is no G-code
    const bool is_second = c == '\n' && after_return_;
    after_return_ = c == '\r';
    if (is_second) continue;
    waiting_.push_back(c);
    if (ends_line(c)) ++ends_;
  }
}

std::optional<GrblInput::Line> GrblInput::take_line() {
  if (ends_ == 0) return {};
  const std::size_t end = waiting_.find_first_of("\r\n");
  Line line;
  bool in_comment = false;
  for (const char c : std::string_view(waiting_).substr(0, end)) {
    if (c == ';' && !in_comment) break;
    if (c == '(') in_comment = true;
    const bool counts = !in_comment && c > ' ' && c != '/' && c != 0x7F;
    if (c == ')') in_comment = false;
    if (!counts || c == ')') continue;
    if (line.text.size() == longest_stripped) {
      line.too_long = true;
      break;
    }
    line.text.push_back(capital(c));
  }
  waiting_.erase(0, end + 1);
  --ends_;
  return line;
}

void GrblInput::clear() {
  waiting_.clear();
  ends_ = 0;
}

}  // namespace passo
