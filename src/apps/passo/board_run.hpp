// A board that a program is run on: opened, asked before and compared after.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "passo/controller/refiller.hpp"
#include "passo/link/board_port.hpp"
#include "passo/machine/machine_counts.hpp"
#include "passo/transport/inquiry.hpp"

namespace passo {

class BoardRun {
 public:
  // Null, and said why, where there is no such board; `code`: what to exit with.
  static std::unique_ptr<BoardRun> open(const std::string& address, std::uint8_t motors, int& code);

  BoardPort& port() { return *port_; }
  // At the end: whether the board has counted the steps that were planned, and those have come out of its pins where
  // these are seen; else what differs.
  std::optional<std::string> compare(const MachineCounts& planned);
  // How often it had to brake by itself.
  void tell(const Refiller& refiller) const;

 private:
  BoardRun(std::unique_ptr<BoardPort> port, std::uint8_t motors);

  std::unique_ptr<BoardPort> port_;
  std::uint8_t motors_;
  BoardStatus before_;
};

}  // namespace passo
