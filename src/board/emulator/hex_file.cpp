#include "passo/emulator/hex_file.hpp"

#include <charconv>
#include <fstream>
#include <string_view>

#include <fmt/format.h>

namespace passo {
namespace {

constexpr std::size_t longest_record = 1 + 2 * (5 + 255);  // characters

// What is wrong with a record; empty: nothing. ":", the number of data bytes, two bytes of address, the type, the data
// and the checksum: with it the bytes add up to 0.
std::string_view record_fault(std::string_view line) {
  if (line.front() != ':') return "it does not begin with ':'";
  const std::string_view digits = line.substr(1);
  if (digits.size() % 2 != 0 || digits.size() < 10 || line.size() > longest_record) return "it is no whole record";
  unsigned sum = 0;
  unsigned first = 0;
  for (std::size_t at = 0; at < digits.size(); at += 2) {
    unsigned byte = 0;
    const char* const end = digits.data() + at + 2;
    const auto [stopped, error] = std::from_chars(digits.data() + at, end, byte, 16);
    if (error != std::errc() || stopped != end) return "it has characters that are no hexadecimal digits";
    if (at == 0) first = byte;
    sum += byte;
  }
  if (digits.size() / 2 != first + 5) return "its length is not the one that it gives";
  return (sum & 0xFF) == 0 ? "" : "its checksum is wrong";
}

}  // namespace

std::string find_hex_fault(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  constexpr std::string_view last_record = ":00000001FF";
  std::size_t number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
    if (line.empty()) continue;
    if (const std::string_view fault = record_fault(line); !fault.empty())
      return fmt::format("line {}: {}", number, fault);
    if (line.substr(7, 2) == last_record.substr(7, 2)) return "";
  }
  return fmt::format("it ends after line {} without a last record ({})", number, last_record);
}

}  // namespace passo
