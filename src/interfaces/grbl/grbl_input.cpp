#include "passo/grbl/grbl_input.hpp"

#include <algorithm>

namespace passo {
namespace {

constexpr std::uint8_t first_high = 0x80;
constexpr std::uint8_t command_follows = 0xC2;  // in UTF-8

bool is_low_command(std::uint8_t byte) {
  return byte == '?' || byte == '!' || byte == '~' || byte == 0x18;
}

bool ends_line(char c) {
  return c == '\n' || c == '\r';
}

char capital(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

// The words of a comment "MSG,words". Empty: it is another comment.
std::string_view message_in(std::string_view comment) {
  constexpr std::string_view keyword = "MSG,";
  std::size_t found = 0;
  for (std::size_t i = 0; i < comment.size(); ++i) {
    if (comment[i] == ' ') continue;
    if (capital(comment[i]) != keyword[found]) return {};
    if (++found == keyword.size()) return comment.substr(i + 1);
  }
  return {};
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
    command_next_ = byte == command_follows;
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
    if (byte == command_follows) continue;
    const bool is_second = c == '\n' && after_return_;
    after_return_ = c == '\r';
    if (is_second) continue;
    waiting_.push_back(c);
    if (ends_line(c)) ++ends_;
  }
}

std::optional<GrblInput::Line> GrblInput::pop_line() {
  if (ends_ == 0) return {};
  const std::size_t end = waiting_.find_first_of("\r\n");
  Line line;
  const std::string_view all = std::string_view(waiting_).substr(0, end);
  std::size_t comment_from = std::string_view::npos;
  for (std::size_t at = 0; at < all.size(); ++at) {
    const char c = all[at];
    const bool in_comment = comment_from != std::string_view::npos;
    if (c == ';' && !in_comment) break;
    if (c == '(' && !in_comment) comment_from = at + 1;
    if (c == ')' && in_comment) {
      line.message = message_in(all.substr(comment_from, at - comment_from));
      comment_from = std::string_view::npos;
    }
    const bool counts = c > ' ' && c < 0x7F && c != '/' && c != '(' && c != ')';
    if (in_comment || !counts) continue;
    if (line.text.size() == longest_stripped) {
      line.too_long = true;
      break;
    }
    line.text.push_back(capital(c));
  }
  waiting_.erase(0, end + 1);
  --ends_;
  line.cancelled = cancelled_ > 0;
  if (line.cancelled) --cancelled_;
  return line;
}

void GrblInput::cancel_jogs() {
  const bool has_begun = !waiting_.empty() && !ends_line(waiting_.back());
  cancelled_ = ends_ + (has_begun ? 1 : 0);
}

void GrblInput::clear() {
  waiting_.clear();
  ends_ = cancelled_ = 0;
}

}  // namespace passo
