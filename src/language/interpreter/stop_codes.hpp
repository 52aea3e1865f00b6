// StopCodes: the codes that stop or end the program: M0, M1, M2, M30, M60; and the dwell G4.
#pragma once

#include "code_family.hpp"
#include "cutter_codes.hpp"
#include "frame_codes.hpp"

namespace passo {

class StopCodes : private CodeFamily {
 public:
  StopCodes(BlockContext& block, CutterCodes& cutter_codes, FrameCodes& frame)
      : CodeFamily(block), cutter_codes_(cutter_codes), frame_(frame) {}

  bool run(CodeNumber code);
  // Executes G4, if the block has one.
  bool dwell();
  // Ends the program: M2 and M30 restore the default state of the machine.
  void end_program(bool pallet);

 private:
  CutterCodes& cutter_codes_;
  FrameCodes& frame_;
};

}  // namespace passo
