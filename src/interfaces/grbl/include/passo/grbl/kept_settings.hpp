// KeptSettings: grbl's numbered settings as changes of the machine file's text. Comments stay.
//
// A setting is a value of the file, in other units: $110 is max_velocity_mm_s of the first axis, times 60. The changed
// text must describe a sound machine, and give the setting the value that was asked for; else nothing is changed.
#pragma once

#include <optional>
#include <string>

#include "passo/machine_file/machine_description.hpp"

namespace passo {

class KeptSettings {
 public:
  // `text`: of the machine file, which parse_machine() has accepted.
  explicit KeptSettings(std::string text) : text_(std::move(text)) {}

  const std::string& text() const { return text_; }
  // The text with the setting changed. Empty: the file has no such setting, or no sound machine has that value;
  // `reason` then tells why, as a sentence without a full stop.
  std::optional<std::string> with(int number, double value, std::string& reason) const;
  void set_text(std::string text) { text_ = std::move(text); }
  // As the text describes it.
  MachineDescription machine() const;

 private:
  std::string text_;
};

}  // namespace passo
