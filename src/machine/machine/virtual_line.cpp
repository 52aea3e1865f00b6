#include "passo/machine/virtual_line.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace passo {
namespace {

constexpr double bits_a_byte = 10;

}  // namespace

VirtualLine::VirtualLine(VirtualMachine& machine, Hertz clock, const LineOptions& options)
    : machine_(machine),
      clock_(clock),
      byte_ticks_(clock.value() * bits_a_byte / options.baud),
      latency_(std::llround(clock * options.latency)) {}

void VirtualLine::cut(Seconds from, Seconds time) {
  cut_from_ = std::llround(clock_ * from);
  cut_to_ =
      std::isinf(time.value()) ? std::numeric_limits<std::int64_t>::max() : cut_from_ + std::llround(clock_ * time);
}

void VirtualLine::receive(std::span<const std::uint8_t> bytes) {
  put(to_board_, true, bytes);
}

void VirtualLine::put(Way& way, bool to_board, std::span<const std::uint8_t> bytes) {
  const std::int64_t now = machine_.now().count;
  Packet packet{.bytes = {bytes.begin(), bytes.end()}};
  if (spoil_) packet.bytes = spoil_(to_board, std::move(packet.bytes));
  way.busy_until = std::max(way.busy_until, now) + std::llround(byte_ticks_ * static_cast<double>(bytes.size()));
  packet.due = way.busy_until + latency_;
  if (!packet.bytes.empty() && !is_cut(now)) way.packets.push_back(std::move(packet));
}

bool VirtualLine::run(Seconds most) {
  const double ticks = clock_ * most;
  const bool bounded = ticks < 9e18;
  const std::int64_t end =
      bounded ? machine_.now().count + std::llround(ticks) : std::numeric_limits<std::int64_t>::max();
  for (;;) {
    deliver();
    if (!arrived_.empty()) return true;
    if (machine_.now().count >= end) return false;
    std::int64_t next = end;
    if (!to_board_.packets.empty()) next = std::min(next, to_board_.packets.front().due);
    if (!to_host_.packets.empty()) next = std::min(next, to_host_.packets.front().due);
    if (machine_.run_to(Ticks{next})) {
      put(to_host_, false, machine_.replies());
    } else if (next == std::numeric_limits<std::int64_t>::max()) {
      return false;
    }
  }
}

// Takes what has arrived by now.
void VirtualLine::deliver() {
  const std::int64_t now = machine_.now().count;
  const auto each_due = [&](Way& way, auto&& take) {
    for (; !way.packets.empty() && way.packets.front().due <= now; way.packets.pop_front()) {
      if (!is_cut(way.packets.front().due)) take(way.packets.front().bytes);
    }
  };
  each_due(to_board_, [&](const Bytes& bytes) { machine_.receive(bytes); });
  each_due(to_host_, [&](const Bytes& bytes) { arrived_.insert(arrived_.end(), bytes.begin(), bytes.end()); });
}

std::span<const std::uint8_t> VirtualLine::replies() {
  taken_.clear();
  taken_.swap(arrived_);
  return taken_;
}

}  // namespace passo
