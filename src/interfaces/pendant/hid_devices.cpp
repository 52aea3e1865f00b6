#include "passo/pendant/hid_devices.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>

#include "passo/base/trimmed.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_file = 4096;

std::string start_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string text(longest_file, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  return text;
}

// The value of a line KEY=VALUE.
std::string_view value_of(std::string_view text, std::string_view key) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    if (line.size() > key.size() && line.starts_with(key) && line[key.size()] == '=')
      return line.substr(key.size() + 1);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return {};
}

// A device may call itself anything. Its name is ASCII here.
std::string printable_name(std::string_view text) {
  std::string name;
  for (const char c : trimmed(text, " \t\r")) {
    if (c >= ' ' && c <= '~' && name.size() < longest_hid_name) name += c;
  }
  return name;
}

std::optional<std::uint16_t> number_in(std::string_view text) {
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, 16);
  const bool is_good = error == std::errc() && end == text.data() + text.size() && number <= 0xFFFF;
  return is_good ? std::optional(static_cast<std::uint16_t>(number)) : std::nullopt;
}

// "0003:000010CE:0000EB93": bus, vendor, product.
bool read_ids(std::string_view text, HidDevice& device) {
  const std::size_t first = text.find(':');
  const std::size_t second = text.find(':', first + 1);
  if (first == std::string_view::npos || second == std::string_view::npos) return false;
  const auto vendor = number_in(text.substr(first + 1, second - first - 1));
  const auto product = number_in(text.substr(second + 1));
  device.vendor = vendor.value_or(0);
  device.product = product.value_or(0);
  return vendor && product;
}

}  // namespace

std::vector<HidDevice> list_hid_devices(const std::string& root) {
  std::vector<HidDevice> all;
  std::error_code error;
  const fs::path folder = fs::path(root.empty() ? "/" : root) / "sys/class/hidraw";
  for (auto entry = fs::directory_iterator(folder, error); !error && entry != fs::directory_iterator();
       entry.increment(error)) {
    if (all.size() == most_hid_devices) break;
    const std::string text = start_of(entry->path() / "device/uevent");
    HidDevice device{.device = (fs::path(root.empty() ? "/" : root) / "dev" / entry->path().filename()).string(),
                     .name = printable_name(value_of(text, "HID_NAME"))};
    if (read_ids(value_of(text, "HID_ID"), device)) all.push_back(std::move(device));
  }
  std::ranges::sort(all, {}, [](const HidDevice& one) { return std::pair(one.device.size(), one.device); });
  return all;
}

}  // namespace passo
