// VirtualLine: a serial link to a simulated machine, in simulated time. Bytes take time, and may be lost.
//
// While the link is cut, all bytes in both directions are lost, including those in transit when the cut begins. Other
// faults are modelled by a function of the caller, which gets every frame from the host and all bytes from the board,
// and returns what arrives instead. A frame arrives when its last byte does.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "passo/link/board_port.hpp"
#include "passo/machine/virtual_machine.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct LineOptions {
  double baud = 500'000;   // 10 bits per byte
  Seconds latency{0.001};  // added in each direction
};

class VirtualLine final : public BoardPort {
 public:
  using Bytes = std::vector<std::uint8_t>;
  // The machine must outlive the link.
  VirtualLine(VirtualMachine& machine, Hertz clock, const LineOptions& options);

  // Cuts the link at the time `from`, for the duration `time`.
  void cut(Seconds from, Seconds time);
  // `spoil(to_board, bytes)` returns the bytes that are transmitted instead of `bytes`.
  void set_trouble(std::function<Bytes(bool to_board, Bytes bytes)> spoil) { spoil_ = std::move(spoil); }

  void receive(std::span<const std::uint8_t> bytes) override;
  [[nodiscard]] bool run(Seconds most) override;
  std::span<const std::uint8_t> replies() override;
  Seconds elapsed() const override { return machine_.elapsed(); }

 private:
  struct Packet {
    std::int64_t due = 0;
    Bytes bytes;
  };
  // One direction of the link.
  struct Way {
    std::deque<Packet> packets;
    std::int64_t busy_until = 0;
  };

  void put(Way& way, bool to_board, std::span<const std::uint8_t> bytes);
  void deliver();
  bool is_cut(std::int64_t time) const { return time >= cut_from_ && time < cut_to_; }

  VirtualMachine& machine_;
  Hertz clock_;
  double byte_ticks_;
  std::int64_t latency_;
  Way to_board_;
  Way to_host_;
  Bytes arrived_;
  Bytes taken_;
  std::int64_t cut_from_ = std::numeric_limits<std::int64_t>::max();
  std::int64_t cut_to_ = std::numeric_limits<std::int64_t>::max();
  std::function<Bytes(bool, Bytes)> spoil_;
};

}  // namespace passo
