// A board that a program is run on: opened, asked before and compared after.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "passo/drive/refiller.hpp"
#include "passo/link/board_port.hpp"
#include "passo/machine/machine_counts.hpp"
#include "passo/plant/plant.hpp"
#include "passo/transport/inquiry.hpp"

namespace passo {

class BoardRun {
 public:
  // Null, and said why, where there is no such board, or it moves though it must not; `code`: what to exit with.
  // `plant`: what is behind the board where that is an emulated one.
  static std::unique_ptr<BoardRun> open(const std::string& address, std::uint8_t motors, bool may_move, Plant& plant,
                                        int& code);

  BoardPort& port() { return *port_; }
  // How it was when it was last asked before the run.
  const BoardStatus& before() const { return before_; }
  // Asks until it does; false where it does not answer.
  [[nodiscard]] bool wait_for_rest();
  // The board has moved since it was asked, and rests; it stands so many steps from machine zero, from where planned
  // steps count. False where it does not answer.
  [[nodiscard]] bool stands_at(const std::array<std::int64_t, max_motors>& steps);
  // Where the planned steps began, if that is not where the board is now.
  void count_from(const std::vector<int>& counts);
  // At the end: whether the board has counted the steps that were planned, and the motors are there where that is
  // known; else what differs.
  std::optional<std::string> compare(const MachineCounts& planned);
  // How often it had to brake by itself.
  void tell(const Refiller& refiller) const;

 private:
  BoardRun(std::unique_ptr<BoardPort> port, std::uint8_t motors, Plant* plant);

  std::unique_ptr<BoardPort> port_;
  std::uint8_t motors_;
  Plant* plant_;  // null: the real world
  BoardStatus before_;
};

}  // namespace passo
