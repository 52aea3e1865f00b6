// OffCodes: leaves out the M5 and M9 of what is off already. The end of a program switches off what the program has
// switched off, and M9 stands for two operations. At the start nobody knows what is on. Private to probing/.
#pragma once

#include <string_view>
#include <utility>

namespace passo {

class OffCodes {
 public:
  // Call with each line that is written. True: the line switches off what is off.
  bool is_off_already(std::string_view line) {
    if (line == "M5") return std::exchange(spindle_is_off_, true);
    if (line == "M9") return std::exchange(coolant_is_off_, true);
    if (line == "M3" || line == "M4") spindle_is_off_ = false;
    if (line == "M7" || line == "M8") coolant_is_off_ = false;
    return false;
  }

 private:
  bool spindle_is_off_ = false;
  bool coolant_is_off_ = false;
};

}  // namespace passo
