#include "passo/emulator/emulated_pico.hpp"

#include <filesystem>
#include <utility>

#include "passo/emulator/emulator_files.hpp"

namespace passo {
namespace {

constexpr const char* died =
    "the Pico's emulator has ended; check that Node.js 18 or later is installed, and that the file is Passo's UF2";

}  // namespace

Result<std::unique_ptr<EmulatedPico>, std::string> EmulatedPico::start(const std::string& program, const PicoPins& pins,
                                                                       PicoSocket socket) {
  const std::filesystem::path folder = emulator_file("pico");
  if (!std::filesystem::exists(folder / "node_modules" / "rp2040js")) {
    return Failure<std::string>{
        "the Pico's emulator is not installed: in a clone of Passo's source, run scripts/install.sh, or `npm ci` in "
        "src/board/emulator/pico"};
  }
  const std::string script = (folder / "emulated_pico.js").string();
  std::unique_ptr<EmulatedPico> pico(new EmulatedPico(
      {"node", script, program, socket == PicoSocket::usb ? "usb" : "uart", std::to_string(pins.spindle_pwm),
       std::to_string(pins.encoder_pulses), std::to_string(pins.encoder_index)},
      died));
  // The first answer shows that the program is there and boots.
  if (!pico->run(1, {})) return Failure<std::string>{pico->error()};
  return pico;
}

}  // namespace passo
