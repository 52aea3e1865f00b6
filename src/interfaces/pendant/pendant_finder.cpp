#include "passo/pendant/pendant_finder.hpp"

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <utility>

#include <fmt/format.h>

namespace passo {
namespace {

constexpr std::string_view device_prefix = "hidraw:";
constexpr std::string_view table_suffix = ".toml";
constexpr std::size_t longest_table = std::size_t{1} << 16;  // bytes

Diagnostic found(const char* code, const std::string& file, std::string message, std::string expected) {
  Diagnostic one;
  one.code = code;
  one.file = file;
  one.message = std::move(message);
  one.expected = std::move(expected);
  return one;
}

bool describes(const PendantTable& table, const HidDevice& device) {
  return table.vendor == device.vendor && table.product == device.product;
}

std::shared_ptr<const PendantTable> read_table(const std::string& file, Diagnostics& diagnostics) {
  std::ifstream in(file, std::ios::binary);
  std::string text(longest_table + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  if (!in.is_open() || in.bad() || text.size() > longest_table) {
    const bool is_read = in.is_open() && !in.bad();
    diagnostics.add(found("pendant.file", file, is_read ? "the table is too long" : "the table cannot be read",
                          fmt::format("a TOML file of at most {} bytes", longest_table)));
    return {};
  }
  auto table = parse_pendant_table(std::move(text), file, diagnostics);
  return table ? std::make_shared<const PendantTable>(std::move(*table)) : nullptr;
}

}  // namespace

const PendantTable* known_pendant(const HidDevice& device) {
  const auto all = known_pendants();
  const auto found = std::ranges::find_if(all, [&](const PendantTable& one) { return describes(one, device); });
  return found != all.end() ? &*found : nullptr;
}

Result<std::unique_ptr<HidrawDevice>, std::string> open_pendant(const FoundPendant& pendant) {
  const PendantTable* const table = pendant.table;
  const bool has_features = table != nullptr && table->display && table->display->is_feature;
  return HidrawDevice::open(pendant.device.device, table != nullptr ? table->length : PendantTable::longest_report,
                            has_features);
}

std::optional<PendantFinder> PendantFinder::make(const std::string& wanted, const std::string& root,
                                                 Diagnostics& diagnostics) {
  PendantFinder finder;
  finder.root_ = root;
  if (wanted == "auto") return finder;
  if (wanted.starts_with(device_prefix) && wanted.size() > device_prefix.size()) {
    finder.device_ = wanted.substr(device_prefix.size());
    return finder;
  }
  if (wanted.ends_with(table_suffix)) {
    finder.table_ = read_table(wanted, diagnostics);
    return finder.table_ ? std::optional(std::move(finder)) : std::nullopt;
  }
  diagnostics.add(found("pendant.name", "--pendant", fmt::format("'{}' is not a pendant", wanted.substr(0, 80)),
                        "auto, hidraw:DEVICE, or a table FILE.toml"));
  return {};
}

std::optional<FoundPendant> PendantFinder::find() const {
  for (HidDevice& device : list_hid_devices(root_)) {
    if (!device_.empty() && device.device != device_) continue;
    const PendantTable* const table = table_ && describes(*table_, device) ? table_.get() : known_pendant(device);
    if (table_ && table != table_.get()) continue;
    if (device_.empty() && table == nullptr) continue;
    return FoundPendant{.device = std::move(device), .table = table};
  }
  return {};
}

}  // namespace passo
