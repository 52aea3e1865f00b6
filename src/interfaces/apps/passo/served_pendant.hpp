// ServedPendant: the pendant of `passo serve`: a USB pendant that is found, opened, and found again after it was
// unplugged, or the handwheel at the pins of the board.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands.hpp"
#include <poll.h>

#include "passo/pendant/board_handwheel.hpp"
#include "passo/pendant/pendant_control.hpp"
#include "passo/pendant/pendant_finder.hpp"

namespace passo {

class ServedPendant {
 public:
  static constexpr Seconds between_searches{1};

  // The USB pendant that --pendant names, otherwise the handwheel of the machine file. Null, with a message and `code`:
  // the name or the table is wrong, or the board has no handwheel. A USB pendant that is not connected is waited for.
  // `text`: of the machine file. All must outlive this object.
  static std::unique_ptr<ServedPendant> open(const ServeArguments& arguments, const PendantMachine& machine,
                                             PendantStatus& status, const std::string& text, int& code);

  // Returns its name, or that it is waited for.
  std::string name() const;
  // The file descriptor that wakes up the loop.
  void add_to(std::vector<pollfd>& all) const;
  // Acts on what was done at the pendant. Must be called once per iteration of the main loop.
  void poll();

 private:
  ServedPendant(PendantFinder finder, const PendantMachine& machine, PendantStatus& status)
      : finder_(std::move(finder)), machine_(machine), status_(status) {}
  static std::unique_ptr<ServedPendant> open_handwheel(const ServeArguments& arguments, const PendantMachine& machine,
                                                       PendantStatus& status, const std::string& text, int& code);
  ServedPendant(std::unique_ptr<BoardHandwheel> handwheel, const PendantMachine& machine, PendantStatus& status)
      : machine_(machine), status_(status), handwheel_(std::move(handwheel)) {}
  Seconds now() const;
  void search();
  void read();
  void lose();

  const std::optional<PendantFinder> finder_;  // empty: of the handwheel
  const PendantMachine machine_;
  PendantStatus& status_;
  const std::unique_ptr<BoardHandwheel> handwheel_;  // null: a USB pendant
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::optional<Seconds> searched_at_;
  std::string trouble_;                      // shown last
  const PendantTable* table_ = nullptr;      // of control_
  std::unique_ptr<PendantDevice> device_;    // null: not connected
  std::unique_ptr<PendantControl> control_;  // null: no pendant has been connected yet
  PendantDevice::Report report_;
};

}  // namespace passo
