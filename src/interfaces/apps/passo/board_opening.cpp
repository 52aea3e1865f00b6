#include "board_opening.hpp"

#include <utility>

#include <fmt/ranges.h>

#include "passo/emulator/emulated_board.hpp"
#include "passo/emulator/emulated_follower.hpp"
#include "passo/transport/stream_port.hpp"

namespace passo {

namespace fs = std::filesystem;

namespace {

// The image of an emulated chip that is not in the build folder is installed with its emulator, that of a board with
// the program. Where neither exists, this is the place in which the build would have put it.
fs::path built_file(const fs::path& name) {
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none).parent_path();
  for (const char* const folder : {PASSO_SHARE_FROM_PROGRAM "/firmware", PASSO_LIBEXEC_FROM_PROGRAM "/firmware"}) {
    fs::path installed = (program / folder / name).lexically_normal();
    if (fs::exists(installed, none)) return installed;
  }
  return program / PASSO_IMAGES_FOLDER / name;
}

}  // namespace

fs::path built_image(std::string_view board, std::string_view extension) {
  return built_file("motion_" + std::string(board) + std::string(extension));
}
fs::path built_follower(std::string_view follower) {
  return built_file(follower_image(follower));
}

std::string message_of_missing(const fs::path& image) {
  return image.string() +
         " is missing: it is in the packages passo and passo-emulators; in a build from source, scripts/start.sh "
         "builds it; "
         "docs/boards.md lists the boards";
}

Result<std::unique_ptr<BoardPort>, std::string> open_addressed(const BoardAddress& address, Plant* plant,
                                                               const PinSetup& wiring) {
  if (address.speaks_grbl) {
    return Failure{
        "a machine with Grbl is not a Passo board: only passo run, jog, home, check, serve and board settings can use "
        "it [board.grbl]"};
  }
  if (address.kind != BoardAddress::Kind::emulated) {
    auto line = open_board(address);
    if (!line) return Failure{line.error()};
    return std::unique_ptr<BoardPort>(std::move(*line));
  }
  if (address.place == "first_board") {
    return Failure{"sim:first_board has no link back to the computer: only passo run can use it [board.one-way]"};
  }
  if (!is_emulated_board(address.place)) {
    return Failure{fmt::format("sim:{}: unknown board; there are emulators of {}, and first_board for passo run",
                               address.place, fmt::join(emulated_boards, ", "))};
  }
  const fs::path image = built_image(address.place, is_pico(address.place) ? ".uf2" : ".elf");
  if (!fs::exists(image)) return Failure{message_of_missing(image)};
  auto board = EmulatedBoard::start(address.place, image);
  if (!board) return Failure{board.error()};
  if (plant != nullptr) (*board)->connect(*plant);
  (*board)->wire(wiring);
  return std::unique_ptr<BoardPort>(std::move(*board));
}

}  // namespace passo
