#include "passo/emulator/emulated_board.hpp"

namespace passo {

Result<std::unique_ptr<EmulatedBoard>, std::string> EmulatedBoard::start(std::string_view /*kind*/,
                                                                         const std::string& /*program*/) {
  return Failure<std::string>{"this program was built without libsimavr, which emulates the chip"};
}

}  // namespace passo
