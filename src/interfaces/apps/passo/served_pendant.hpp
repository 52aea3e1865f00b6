// ServedPendant: the pendant of `passo serve`: found, opened, and found again after it was unplugged.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"
#include <poll.h>

#include "passo/pendant/pendant_control.hpp"
#include "passo/pendant/pendant_finder.hpp"

namespace passo {

class ServedPendant {
 public:
  static constexpr Seconds between_searches{1};

  // Null, with a message and `code`: the name or the table is wrong. A pendant that is not connected is waited for. All
  // must outlive this object.
  static std::unique_ptr<ServedPendant> open(const ServeArguments& arguments, const PendantMachine& machine,
                                             PendantStatus& status, int& code);

  // Returns its name, or that it is waited for.
  std::string name() const;
  // The file descriptor that wakes up the loop.
  void add_to(std::vector<pollfd>& all) const;
  // Acts on what was done at the pendant. Must be called once per iteration of the main loop.
  void poll();

 private:
  ServedPendant(PendantFinder finder, const PendantMachine& machine, PendantStatus& status)
      : finder_(std::move(finder)), machine_(machine), status_(status) {}
  Seconds now() const;
  void search();
  void read();
  void lose();

  const PendantFinder finder_;
  const PendantMachine machine_;
  PendantStatus& status_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::optional<Seconds> searched_at_;
  std::string trouble_;                      // shown last
  const PendantTable* table_ = nullptr;      // of control_
  std::unique_ptr<PendantDevice> device_;    // null: not connected
  std::unique_ptr<PendantControl> control_;  // null: no pendant has been connected yet
  PendantDevice::Report report_;
};

}  // namespace passo
