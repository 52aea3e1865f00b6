// InputOutputCodes: the codes for the machine's inputs and outputs: M62 to M68, and M100 to M199.
#pragma once

#include "code_family.hpp"

namespace passo {

class InputOutputCodes : private CodeFamily {
 public:
  explicit InputOutputCodes(BlockContext& block) : CodeFamily(block) {}

  bool run(CodeNumber code);
  bool run_user_code(CodeNumber code);

 private:
  bool set_digital_output(CodeNumber code);
  bool set_analog_output(bool with_motion);
  bool read_input();
};

}  // namespace passo
