// KeptSettings: applies grbl's numbered settings to the text of the machine file. Comments are preserved.
//
// A setting is a value of the file in other units: $110 is max_velocity_mm_s of the first axis, times 60. The changed
// text must describe a valid machine and give the setting the requested value; otherwise nothing is changed.
#pragma once

#include <optional>
#include <string>

#include "passo/machine_file/machine_description.hpp"

namespace passo {

class KeptSettings {
 public:
  // `text`: the contents of the machine file, which parse_machine() must have accepted.
  explicit KeptSettings(std::string text) : text_(std::move(text)) {}

  const std::string& text() const { return text_; }
  // Returns the text with the setting changed. Empty if the file has no such setting, or if no valid machine has that
  // value; `reason` is then set, as a sentence without a full stop.
  std::optional<std::string> with(int number, double value, std::string& reason) const;
  void set_text(std::string text) { text_ = std::move(text); }
  // Returns the machine described by the text.
  MachineDescription machine() const;

 private:
  std::string text_;
};

}  // namespace passo
