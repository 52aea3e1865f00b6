#include "dxf_groups.hpp"

#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

namespace passo {
namespace {

constexpr std::string_view binary_mark("AutoCAD Binary DXF\r\n\x1A\0", 22);
constexpr std::size_t shown_text = 200;
static_assert(std::endian::native == std::endian::little, "binary DXF files are little-endian, and read by memcpy");

enum class GroupValue : std::uint8_t { text, real, int16, int32, int64, byte, chunk };

// What the value of a code is, from the reference's table of group codes.
GroupValue value_of(int code) {
  const auto in = [code](int low, int high) { return code >= low && code <= high; };
  if (in(10, 59) || in(110, 149) || in(210, 239) || in(460, 469) || in(1010, 1059)) return GroupValue::real;
  if (in(60, 79) || in(170, 179) || in(270, 289) || in(370, 389) || in(400, 409) || in(1060, 1070)) {
    return GroupValue::int16;
  }
  if (in(90, 99) || in(420, 429) || in(440, 459) || code == 1071) return GroupValue::int32;
  if (in(160, 169)) return GroupValue::int64;
  if (in(290, 299)) return GroupValue::byte;
  if (in(310, 319) || code == 1004) return GroupValue::chunk;
  return GroupValue::text;
}

template <class T>
double number_in(std::string_view bytes) {
  T value{};
  std::memcpy(&value, bytes.data(), sizeof value);
  return static_cast<double>(value);
}

}  // namespace

DxfGroups::DxfGroups(const std::string& file, std::string_view text, Diagnostics& diagnostics)
    : file_(file), text_(text), lines_(text), diagnostics_(diagnostics), is_binary_(text.starts_with(binary_mark)) {
  at_ = binary_mark.size();
  has_short_codes_ = is_binary_ && text.size() > at_ + 1 && text[at_ + 1] != 0;
}

bool DxfGroups::next(DxfGroup& group) {
  if (has_failed_) return false;
  return is_binary_ ? next_binary(group) : next_of_text(group);
}

void DxfGroups::refuse(std::uint32_t line, std::string code, std::string message, std::string expected) {
  if (is_binary_) message += fmt::format(", at byte {}", at_);
  const bool is_here = !is_binary_ && line == lines_.number();
  const auto length = static_cast<std::uint32_t>(std::max<std::size_t>(1, std::min(line_.size(), shown_text)));
  diagnostics_.add({.code = std::move(code),
                    .file = file_,
                    .place = {is_binary_ ? 0 : line, is_binary_ ? 0U : 1U, is_here ? length : 1},
                    .message = std::move(message),
                    .expected = std::move(expected),
                    .text = is_here ? std::string(line_.substr(0, shown_text)) : std::string()});
}

bool DxfGroups::next_of_text(DxfGroup& group) {
  do {
    if (!lines_.next(line_)) return false;
    // A code of 999 is a comment; some files have empty lines at their end.
  } while (trimmed(line_).empty());
  const std::string_view digits = trimmed(line_);
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), group.code);
  if (error != std::errc() || end != digits.data() + digits.size() || group.code < -5 || group.code > 1071) {
    has_failed_ = true;
    refuse(lines_.number(), "dxf.bad-code", "this line should be a group code",
           "a whole number from -5 to 1071; each is followed by a line with its value");
    return false;
  }
  if (!lines_.next(line_)) return is_cut_off();
  group.line = lines_.number();
  group.text = trimmed(line_);
  group.number = 0;
  const GroupValue kind = value_of(group.code);
  if (kind == GroupValue::text || kind == GroupValue::chunk) return true;
  std::string_view number = group.text;
  if (number.starts_with('+')) number.remove_prefix(1);
  const auto [stop, fault] = std::from_chars(number.data(), number.data() + number.size(), group.number);
  if (fault == std::errc::result_out_of_range && stop == number.data() + number.size()) return true;  // 1e-400 is 0
  if (fault == std::errc() && stop == number.data() + number.size() && std::isfinite(group.number)) return true;
  has_failed_ = true;
  refuse(group.line, "dxf.bad-number", fmt::format("the value of group {} is no number", group.code),
         "a number, as in 12.5");
  return false;
}

bool DxfGroups::is_cut_off() {
  has_failed_ = true;
  refuse(lines_.number(), "dxf.cut-off", "the file ends in the middle of a group", "the whole file");
  return false;
}

bool DxfGroups::read_bytes(std::size_t bytes, std::string_view& taken) {
  if (bytes > text_.size() - at_) return is_cut_off();
  taken = text_.substr(at_, bytes);
  at_ += bytes;
  return true;
}

bool DxfGroups::next_binary(DxfGroup& group) {
  if (at_ >= text_.size()) return false;
  std::string_view bytes;
  if (has_short_codes_) {
    if (!read_bytes(1, bytes)) return false;
    group.code = static_cast<unsigned char>(bytes[0]);
    if (group.code == 255) {
      if (!read_bytes(2, bytes)) return false;
      group.code = static_cast<int>(number_in<std::int16_t>(bytes));
    }
  } else {
    if (!read_bytes(2, bytes)) return false;
    group.code = static_cast<int>(number_in<std::int16_t>(bytes));
  }
  group.line = 0;
  group.number = 0;
  group.text = {};
  return read_binary_value(group);
}

bool DxfGroups::read_binary_value(DxfGroup& group) {
  std::string_view bytes;
  switch (value_of(group.code)) {
    case GroupValue::text: {
      const std::size_t end = text_.find('\0', at_);
      if (end == std::string_view::npos) return is_cut_off();
      group.text = trimmed(text_.substr(at_, end - at_));
      at_ = end + 1;
      return true;
    }
    case GroupValue::chunk: return read_bytes(1, bytes) && read_bytes(static_cast<unsigned char>(bytes[0]), group.text);
    case GroupValue::real:
      if (!read_bytes(8, bytes)) return false;
      group.number = number_in<double>(bytes);
      if (std::isfinite(group.number)) return true;
      has_failed_ = true;
      refuse(0, "dxf.bad-number", fmt::format("the value of group {} is not finite", group.code), "");
      return false;
    case GroupValue::int16: return read_bytes(2, bytes) && (group.number = number_in<std::int16_t>(bytes), true);
    case GroupValue::int32: return read_bytes(4, bytes) && (group.number = number_in<std::int32_t>(bytes), true);
    case GroupValue::int64: return read_bytes(8, bytes) && (group.number = number_in<std::int64_t>(bytes), true);
    case GroupValue::byte: return read_bytes(1, bytes) && (group.number = number_in<std::uint8_t>(bytes), true);
  }
  return false;
}

}  // namespace passo
