// The drive as which a Raspberry Pi Pico shows itself while its boot loader runs, and the firmware's way there.
#pragma once

#include "commands.hpp"

namespace passo {

// passo board flash, for boards that are flashed by copying a file to their drive.
int flash_by_copying(const BoardFlashArguments& arguments);

}  // namespace passo
