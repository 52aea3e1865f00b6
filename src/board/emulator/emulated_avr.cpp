#include "passo/emulator/emulated_avr.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "passo/emulator/emulator_files.hpp"

namespace passo {

Result<std::string, std::string> avr_emulator() {
  const std::filesystem::path found = emulator_file("passo-emulate-avr");
  if (!found.empty()) return found.string();
  return Failure<std::string>{
      "passo-emulate-avr, which emulates the Uno and the Mega, is missing: it is in the package passo-emulators; in a "
      "build from source, scripts/start.sh builds it if libsimavr-dev and libelf-dev are installed"};
}

std::uint32_t PinNumbers::number(Pin pin, bool when_drawn_low) {
  if (!pin.exists()) return 0;
  auto found = std::ranges::find_if(pins_, [&](const Numbered& one) { return one.pin == pin; });
  if (found == pins_.end()) found = pins_.insert(found, {pin, when_drawn_low});
  return std::uint32_t{1} << static_cast<unsigned>(found - pins_.begin());
}

std::string PinNumbers::text() const {
  std::string text;
  for (const auto& [pin, when_drawn_low] : pins_) {
    text += fmt::format("{}{}{}{}", text.empty() ? "" : ",", when_drawn_low ? "!" : "", pin.port, pin.bit);
  }
  return text;
}

}  // namespace passo
