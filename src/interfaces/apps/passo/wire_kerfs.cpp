#include "wire_kerfs.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace passo {

std::vector<WireKerf> kerfs_of(const char* option, const std::string& text, std::optional<double> feed,
                               LengthArguments& lengths) {
  std::vector<WireKerf> kerfs;
  std::string_view rest = text;
  while (!rest.empty()) {
    const std::string_view part = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(rest.size(), part.size() + 1));
    const std::size_t at = part.find('@');
    const Nanometres width = lengths.any(option, std::string(part.substr(0, at)));
    constexpr Nanometres widest{50'000'000};
    if (width.count < 0 || width > widest) lengths.refuse(fmt::format("{}: expected a width of 0 to 50 mm", option));
    if (at != std::string_view::npos) {
      const Nanometres speed = lengths.above_0(option, std::string(part.substr(at + 1)));
      kerfs.push_back({to_mm(speed).value(), to_mm(width).value()});
    } else if (feed) {
      kerfs.push_back({*feed, to_mm(width).value()});
    } else {
      // Between two equal widths, and beyond them, the width is the same.
      for (const double speed : {1.0, 1e5}) kerfs.push_back({speed, to_mm(width).value()});
    }
  }
  std::ranges::sort(kerfs, {}, &WireKerf::speed);
  const auto same = std::ranges::adjacent_find(kerfs, {}, &WireKerf::speed);
  if (kerfs.empty() || same != kerfs.end()) {
    lengths.refuse(fmt::format("{}: expected WIDTH, or WIDTH@SPEED,... at different speeds, found '{}'", option, text));
  }
  return kerfs;
}

}  // namespace passo
