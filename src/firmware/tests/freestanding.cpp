// Compiled without a standard library, as for a chip: the portable modules include nothing that is not there.
#include "passo/firmware/board.hpp"

namespace passo {

struct NoHardware {
  void step(uint8_t, uint8_t) {}
  void outputs(const BoardOutputs&) {}
  void send(uint8_t) {}
};
template class Board<NoHardware, 16>;

}  // namespace passo
