#include "passo/emulator/emulated_board.hpp"
#include "passo/emulator/emulated_pico.hpp"

namespace passo {

Result<std::unique_ptr<EmulatedBoard>, std::string> EmulatedBoard::start(std::string_view kind,
                                                                         const std::string& program) {
  if (kind == "pico") return start_pico_board(program);
  return Failure<std::string>{"this program was built without libsimavr, which emulates the chip"};
}

}  // namespace passo
