// Compiled without a standard library, as for a chip: checks that the portable modules include nothing else.
#include "passo/firmware/board.hpp"
#include "passo/firmware/manual_mode.hpp"

namespace passo {

struct NoHardware {
  void step(uint8_t, uint8_t) {}
  void outputs(const BoardOutputs&) {}
  void send(uint8_t) {}
};
template class Board<NoHardware, 16>;

struct NoKeys {
  static uint8_t rows() { return 0; }
  static void draw_column(uint8_t) {}
  static bool tool_button() { return false; }
  static void indicators(bool, bool) {}
};
template class ManualMode<NoKeys, Board<NoHardware, 16>>;

}  // namespace passo
