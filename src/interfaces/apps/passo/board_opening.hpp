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

// The path at which the build puts the firmware `motion` for `board`, found from the place of this program.
// `extension`: ".hex" or ".elf".
std::filesystem::path built_image(std::string_view board, std::string_view extension);
// The same for the follower of this name.
std::filesystem::path built_follower(std::string_view follower);
std::string message_of_missing(const std::filesystem::path& image);

// Opens a board over a line or in an emulator, but not the virtual machine. `plant`: the plant behind an emulated
// board, which outlives the board; null: nothing but its motors. `wiring`: how that plant is connected to the board's
// pins. The error is a sentence with the reason.
Result<std::unique_ptr<BoardPort>, std::string> open_addressed(const BoardAddress& address, Plant* plant = nullptr,
                                                               const PinSetup& wiring = {});

}  // namespace passo
