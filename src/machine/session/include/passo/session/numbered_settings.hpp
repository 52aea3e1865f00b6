// NumberedSettings: the settings $0 … of a board that plans its own motion, for clients that speak its protocol. Other
// machines have none: the machine file describes them.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace passo {

class NumberedSettings {
 public:
  virtual ~NumberedSettings() = default;
  NumberedSettings(const NumberedSettings&) = delete;
  NumberedSettings& operator=(const NumberedSettings&) = delete;

  // Returns numbers and values, as the board has reported them last, in the order of the numbers.
  virtual std::vector<std::pair<int, std::string>> all() const = 0;
  // Begins to write a setting, and to read it back, while the machine rests. One at a time: another write replaces one
  // that has not begun.
  virtual void write(int number, std::string value) = 0;
  // Continues that. Must be called after each poll of the session. Returns, once, how it has ended: an empty text if
  // the board has the new value; otherwise why the old one is in force, a sentence without a full stop.
  virtual std::optional<std::string> poll_write() = 0;

 protected:
  NumberedSettings() = default;
};

}  // namespace passo
