// The USB drive of a Raspberry Pi Pico's boot loader, and flashing through it.
#pragma once

#include "commands.hpp"

namespace passo {

// Implements `passo board flash` for boards that are flashed by copying a file to their drive.
int flash_by_copying(const BoardFlashArguments& arguments);

}  // namespace passo
