// Opens a board by its address.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "passo/base/result.hpp"
#include "passo/link/board_port.hpp"
#include "passo/plant/plant.hpp"
#include "passo/transport/board_address.hpp"
#include "passo/wire/message.hpp"

namespace passo {

// Returns the path of the firmware `motion` for `board`, installed or in the build folder. Both are found by the
// location of this program. `extension`: ".hex", ".elf" or ".uf2".
std::filesystem::path built_image(std::string_view board, std::string_view extension);
// Returns the same for the follower of this name.
std::filesystem::path built_follower(std::string_view follower);
std::string message_of_missing(const std::filesystem::path& image);

// Opens a board over a serial link or in an emulator, but not the virtual machine. `plant`: the plant behind an
// emulated board, which must outlive the board; null: only its motors. `wiring`: the connections from that plant to the
// board's pins. The error is a sentence with the reason.
Result<std::unique_ptr<BoardPort>, std::string> open_addressed(const BoardAddress& address, Plant* plant = nullptr,
                                                               const PinSetup& wiring = {});

}  // namespace passo
