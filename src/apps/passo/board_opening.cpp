#include "board_opening.hpp"

#include <utility>

#include <fmt/ranges.h>

#include "passo/emulator/emulated_board.hpp"
#include "passo/transport/stream_port.hpp"

namespace passo {

namespace fs = std::filesystem;

fs::path built_image(std::string_view board, std::string_view extension) {
  std::error_code none;
  return fs::read_symlink("/proc/self/exe", none).parent_path() / "src" / "chip" /
         ("motion_" + std::string(board) + std::string(extension));
}

std::string message_of_missing(const fs::path& image) {
  return image.string() + " is not there: scripts/test.sh builds the images; docs/boards.md says for which boards";
}

Result<std::unique_ptr<BoardPort>, std::string> open_addressed(const BoardAddress& address, Plant* plant,
                                                               const PinSetup& wiring) {
  if (address.kind != BoardAddress::Kind::emulated) {
    auto line = open_board(address);
    if (!line) return Failure{line.error()};
    return std::unique_ptr<BoardPort>(std::move(*line));
  }
  if (!is_emulated_board(address.place)) {
    return Failure{fmt::format("sim:{}: there is an emulator of {}", address.place, fmt::join(emulated_boards, ", "))};
  }
  const fs::path image = built_image(address.place, address.place == "pico" ? ".uf2" : ".elf");
  if (!fs::exists(image)) return Failure{message_of_missing(image)};
  auto board = EmulatedBoard::start(address.place, image);
  if (!board) return Failure{board.error()};
  if (plant != nullptr) (*board)->connect(*plant);
  (*board)->wire(wiring);
  return std::unique_ptr<BoardPort>(std::move(*board));
}

}  // namespace passo
