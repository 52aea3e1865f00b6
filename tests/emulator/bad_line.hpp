// BadLine: a line to an emulated board that is cut or makes mistakes.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>

#include "kit/line_trouble.hpp"

#include "passo/emulator/emulated_board.hpp"
#include "passo/link/board_port.hpp"

namespace passo::test {

// Between a link and a board: silence from one frame on for a time, or random faults.
class BadLine final : public BoardPort {
 public:
  explicit BadLine(EmulatedBoard& board) : board_(board) {}

  void go_bad(std::uint64_t seed) { trouble_.emplace(seed); }
  // Another trouble than random faults.
  void set_trouble(std::function<Bytes(bool to_board, const Bytes&)> spoil) { spoil_ = std::move(spoil); }
  void cut_at(std::uint64_t frame, Seconds time) {
    cut_frame_ = frame;
    missing_ = time;
  }
  std::uint64_t frames() const { return frames_; }
  int faults() const { return trouble_ ? trouble_->faults : 0; }

  void receive(std::span<const std::uint8_t> bytes) override {
    if (frames_++ == cut_frame_) cut_to_ = board_.elapsed() + missing_;
    if (is_cut()) return;
    const Bytes sent(bytes.begin(), bytes.end());
    board_.receive(spoilt(true, sent));
  }
  bool run(Seconds most) override {
    const bool said = board_.run(most);
    const auto bytes = board_.replies();
    Bytes heard(bytes.begin(), bytes.end());
    if (!heard.empty()) heard = spoilt(false, heard);
    if (!is_cut()) heard_.insert(heard_.end(), heard.begin(), heard.end());
    return said;
  }
  std::span<const std::uint8_t> replies() override {
    taken_ = std::exchange(heard_, {});
    return taken_;
  }
  Seconds elapsed() const override { return board_.elapsed(); }

 private:
  Bytes spoilt(bool to_board, const Bytes& bytes) {
    if (spoil_) return spoil_(to_board, bytes);
    return trouble_ ? (*trouble_)(to_board, bytes) : bytes;
  }
  bool is_cut() const { return board_.elapsed() < cut_to_; }

  EmulatedBoard& board_;
  std::optional<RandomTrouble> trouble_;
  std::function<Bytes(bool, const Bytes&)> spoil_;
  std::uint64_t frames_ = 0;
  std::uint64_t cut_frame_ = UINT64_MAX;
  Seconds missing_{0};
  Seconds cut_to_{0};
  Bytes heard_;
  Bytes taken_;
};

}  // namespace passo::test
