// MachineLines: what lines of G-code of the machine file (the macro of a tool change, the hooks of a program) may leave
// behind in the program that calls them. Modes are restored by BlockExecutor, as M73 does; T and G51 are restored here.
// Other offsets or another tool are faults: nobody knows why the lines have changed them.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "code_family.hpp"
#include "frame_codes.hpp"
#include "modal_snapshot.hpp"

namespace passo {

class MachineLines : private CodeFamily {
 public:
  MachineLines(BlockContext& block, FrameCodes& frame) : CodeFamily(block), frame_(frame) {}

  // #5210 to #5390: G92, and the work coordinate systems.
  static constexpr int last_offset_parameter = rotation_parameter(work_systems);
  using Offsets = std::array<double, last_offset_parameter - g92_active_parameter + 1>;
  // The state at the call.
  struct Before {
    int depth = 0;              // call depth of the caller
    std::int32_t tool = 0;      // in the spindle
    std::int32_t selected = 0;  // by the last T
    ModalSnapshot modes;
    Scaling scaling;
    Offsets offsets{};
  };
  Before before() const;
  // Called when the lines are done, before the modes are restored. Returns what is wrong: "has changed …". Empty:
  // nothing. `next`: the lines may put this tool into the spindle.
  std::string put_back(const Before& before, std::int32_t next);

 private:
  Offsets offsets() const;
  void put_back(const Offsets& all);

  FrameCodes& frame_;
};

}  // namespace passo
