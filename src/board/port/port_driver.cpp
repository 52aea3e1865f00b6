#include "passo/port/port_driver.hpp"

#include <algorithm>

namespace passo {
namespace {

constexpr std::array written{ParallelPort::Register::data, ParallelPort::Register::control};

}  // namespace

PortDriver::PortDriver(std::int64_t pulse, const PortPins& pins) : pulse_(pulse), pins_(pins) {
  for (const int pin : pins_.clock) add({0, pin, false});
  for (const int pin : pins_.direction) add({0, pin, false});
  add({0, pins_.tool, false});
}

void PortDriver::add(const Change& change) {
  const auto place = std::ranges::upper_bound(changes_, change.at, {}, &Change::at);
  changes_.insert(place, change);
}

void PortDriver::step(std::int64_t at, unsigned stepped, unsigned down) {
  for (std::size_t m = 0; m < port_axes; ++m) {
    if ((stepped >> m & 1) == 0) continue;
    const bool goes_down = (down >> m & 1) != 0;
    if (goes_down != down_[m]) add({at, pins_.direction[m], goes_down});
    down_[m] = goes_down;
    add({at + pulse_, pins_.clock[m], true});
    add({at + 2 * pulse_, pins_.clock[m], false});
  }
}

void PortDriver::switch_tool(std::int64_t at, bool on) {
  add({at, pins_.tool, on});
}

std::vector<PortWrite> PortDriver::take(std::int64_t end) {
  std::vector<PortWrite> writes;
  while (!changes_.empty() && changes_.front().at < end) {
    const std::int64_t at = changes_.front().at;
    std::array<std::uint8_t, written.size()> values{};
    for (std::size_t i = 0; i < written.size(); ++i) values[i] = port_.read(written[i]);
    for (; !changes_.empty() && changes_.front().at == at; changes_.pop_front()) {
      const auto bit = ParallelPort::bit_of(changes_.front().pin);
      if (!bit || bit->of == ParallelPort::Register::status) continue;
      const std::size_t which = bit->of == written[0] ? 0 : 1;
      const auto mask = static_cast<std::uint8_t>(1U << bit->number);
      const bool is_one = changes_.front().high != bit->inverted;
      values[which] = static_cast<std::uint8_t>(is_one ? values[which] | mask : values[which] & ~mask);
    }
    for (std::size_t i = 0; i < written.size(); ++i) {
      if (values[i] == port_.read(written[i])) continue;
      port_.write(written[i], values[i]);
      writes.push_back({at, written[i], values[i]});
    }
  }
  return writes;
}

}  // namespace passo
