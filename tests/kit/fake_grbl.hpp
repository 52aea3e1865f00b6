// FakeGrbl: a StrictGrbl on a TCP port of this computer.
#pragma once

#include "kit/board_on_port.hpp"
#include "kit/strict_grbl.hpp"

namespace passo::test {

class FakeGrbl : public BoardOnPort<StrictGrbl> {
 public:
  // `each` is called in each iteration, in the machine's thread.
  explicit FakeGrbl(StrictGrbl machine, std::function<void(StrictGrbl&)> each = {})
      : BoardOnPort(as_fast_as_a_router(std::move(machine)), std::move(each)) {}

 private:
  // So that tests are short.
  static StrictGrbl as_fast_as_a_router(StrictGrbl machine) {
    for (const int axis : {0, 1, 2}) {
      machine.put(110 + axis, 6000);
      machine.put(120 + axis, 500);
    }
    return machine;
  }
};

}  // namespace passo::test
