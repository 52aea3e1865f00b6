// StrictCardBoard: a StrictGrbl with a card, which says that it is grblHAL or FluidNC.
#pragma once

#include <string>

#include "kit/board_with_files.hpp"
#include "kit/strict_grbl.hpp"

namespace passo::test {

using StrictCardBoard = BoardWithFilesOn<StrictGrbl>;

inline StrictCardBoard strict_grblhal_with_card(const std::string& options = "ENUMS,RT+,SED,SD,YM") {
  StrictGrbl grbl(1024);
  grbl.greeting = "GrblHAL 1.1f ['$' or '$HELP' for help]";
  grbl.version = "1.1f.20260817:";
  grbl.options = "VNML+,100,1024";
  StrictCardBoard board(std::move(grbl), false);
  board.answers["$I+"] = {"[VER:1.1f.20260817:]", "[OPT:VNML+,100,1024,3,0]", "[AXS:3:XYZ]", "[NEWOPT:" + options + "]",
                          "[FIRMWARE:grblHAL]"};
  return board;
}

inline StrictCardBoard strict_fluidnc_with_card() {
  StrictGrbl grbl;
  grbl.greeting = "Grbl 4.0 [FluidNC v4.0.1 (wifi) '$' for help]";
  grbl.version = "4.0 FluidNC v4.0.1:";
  grbl.options = "MPHS,15,128";
  return {std::move(grbl), true};
}

}  // namespace passo::test
