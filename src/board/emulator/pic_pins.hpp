// PicPins: where the follower's lines and outputs are on a PIC16F877A.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "passo/emulator/emulated_follower.hpp"

namespace passo {

// Where a line is on the chip, and whether the pin is high while the line is.
struct InputPin {
  std::string pin;
  bool straight = true;
};
// The bits of an output on its port, F1 first.
struct OutputPins {
  std::string port;
  std::vector<unsigned> bits;
  bool straight = true;
};
struct PicPins {
  Nanoseconds cycle = 0;  // of an instruction
  std::map<std::string, InputPin> inputs;
  std::map<std::string, OutputPins> outputs;
  std::array<int, 4> rows;  // bits of port B
  std::array<int, 3> columns;
};

PicPins pins_of(PicFollower board);

}  // namespace passo
