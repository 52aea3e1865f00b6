// --touch: what stands on the virtual machine for its probe to touch.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "passo/activity/touch_box.hpp"
#include "passo/link/board_port.hpp"
#include "passo/machine/virtual_machine.hpp"

namespace passo {

// "Z:-1.5" is everything below, "X10:60,Y10:50,Z:-2" a block: from where to where on each axis, machine coordinates;
// an end that is not there, or an axis, goes on for ever. Nothing where a text says something else, or names an axis
// that the machine has not; that is told on standard error.
std::optional<std::vector<TouchBox>> read_touch_options(const std::vector<std::string>& texts,
                                                        const MachineDescription& machine);

// For the probe of the virtual machine; where `board` is not null, for that of the emulated board that it is. False
// where it is a real one.
bool put_touch_boxes(const std::vector<TouchBox>& boxes, const MachineDescription& description, VirtualMachine& machine,
                     BoardPort* board);

}  // namespace passo
