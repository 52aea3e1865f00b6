#include "passo/journal/record_text.hpp"

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

#include "passo/base/fingerprint.hpp"

namespace passo {
namespace {

constexpr std::string_view check_word = "check ";

}  // namespace

std::string record_check(std::string_view text) {
  Fingerprint fingerprint;
  fingerprint.add(text);
  return fmt::format("{:016x}", fingerprint.value());
}

std::string record_name(std::string_view name) {
  std::string text;
  for (const char c : name) {
    if (c == '%' || static_cast<unsigned char>(c) < ' ') {
      text += fmt::format("%{:02x}", static_cast<unsigned char>(c));
    } else {
      text += c;
    }
  }
  return text;
}

void end_record(std::string& text) {
  text += fmt::format("{}{}\n", check_word, record_check(text));
}

std::optional<RecordParts> read_record(std::string_view text, std::string_view title) {
  if (!text.starts_with(title)) return {};
  const std::size_t check = text.find(std::string("\n").append(check_word));
  if (check == std::string_view::npos) return {};
  const std::string_view checked = text.substr(0, check + 1);
  const std::string_view digits = text.substr(checked.size() + check_word.size(), record_check_size + 1);
  if (digits != record_check(checked) + '\n') return {};
  return RecordParts{.body = checked.substr(title.size()),
                     .rest = text.substr(checked.size() + check_word.size() + digits.size())};
}

std::string RecordWords::name() {
  const std::size_t end = text_.find('\n');
  require(end != std::string_view::npos && text_.starts_with(' '));
  if (!good_) return {};
  const std::string_view all = text_.substr(1, end - 1);
  text_.remove_prefix(end);
  std::string plain;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i] != '%') {
      plain += all[i];
      continue;
    }
    RecordWords code(all.substr(i + 1, 2));
    plain += static_cast<char>(code.number<std::uint8_t>(16));
    require(code.good());
    i += 2;
  }
  return plain;
}

std::string_view RecordWords::next() {
  text_.remove_prefix(std::min(text_.find_first_not_of(" \n"), text_.size()));
  const std::string_view word = text_.substr(0, std::min(text_.find_first_of(" \n"), text_.size()));
  text_.remove_prefix(word.size());
  return word;
}

}  // namespace passo
