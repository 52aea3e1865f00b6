// OffCodes: omits M5 and M9 if the spindle or coolant is already off. The end of a program switches off what the
// program has already switched off, and M9 is two operations. The state at the start is unknown. Private to probing/.
#pragma once

#include <string_view>
#include <utility>

namespace passo {

class OffCodes {
 public:
  // Must be called with each line to be written. Returns true if the line only switches off what is already off.
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
