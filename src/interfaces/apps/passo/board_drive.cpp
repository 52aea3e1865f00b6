#include "board_drive.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "board_opening.hpp"
#include "program_input.hpp"
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "passo/base/result.hpp"
#include "passo/chip/uf2.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t flash_of_pico = 2U << 20;

// The boot loader's drive has a file with the chip's name. RP2040 datasheet, 2.8.4.
bool is_drive_of_pico(const fs::path& directory) {
  std::ifstream file(directory / "INFO_UF2.TXT");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("Board-ID: RPI-RP2")) return true;
  }
  return false;
}

// The kernel writes a blank in a path as \040.
std::string unescaped(const std::string& path) {
  std::string text;
  for (std::size_t at = 0; at < path.size(); ++at) {
    if (path.compare(at, 4, "\\040") == 0) {
      text += ' ';
      at += 3;
    } else {
      text += path[at];
    }
  }
  return text;
}

std::vector<fs::path> drives_of_picos() {
  std::vector<fs::path> found;
  std::ifstream mounts("/proc/mounts");
  std::string device;
  std::string place;
  std::string kind;
  for (std::string rest; mounts >> device >> place >> kind && std::getline(mounts, rest);) {
    if (kind != "vfat") continue;
    const fs::path directory = unescaped(place);
    if (is_drive_of_pico(directory)) found.push_back(directory);
  }
  return found;
}

Result<fs::path, std::string> drive_of(const BoardFlashArguments& arguments) {
  if (!arguments.device.empty()) {
    if (is_drive_of_pico(arguments.device)) return fs::path(arguments.device);
    return Failure{arguments.device + " is not the drive of a Pico's boot loader: it has no INFO_UF2.TXT with RPI-RP2"};
  }
  const std::vector<fs::path> drives = drives_of_picos();
  if (drives.empty()) {
    return Failure<std::string>{
        "there is no drive RPI-RP2: hold the Pico's BOOTSEL button while you plug in its cable, and mount the drive"};
  }
  if (drives.size() > 1) {
    return Failure{fmt::format("there are {} Picos, e.g. at {} and {}: select one drive with --device", drives.size(),
                               drives[0].string(), drives[1].string())};
  }
  return drives.front();
}

// The Pico restarts as soon as it has the last block, and its drive is gone. So there is no temporary name, and an
// error of the closing says nothing.
std::string copy_to_drive(const std::vector<char>& bytes, const fs::path& target) {
  const int file = ::open(target.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0) return std::strerror(errno);
  std::string wrong;
  for (std::size_t sent = 0; sent < bytes.size() && wrong.empty();) {
    const ssize_t wrote = ::write(file, bytes.data() + sent, bytes.size() - sent);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) wrong = std::strerror(errno);
    if (wrote > 0) sent += static_cast<std::size_t>(wrote);
  }
  static_cast<void>(::fsync(file));
  static_cast<void>(::close(file));
  return wrong;
}

}  // namespace

int flash_by_copying(const BoardFlashArguments& arguments) {
  const std::string image = arguments.image.empty() ? built_image(arguments.board, ".uf2").string() : arguments.image;
  std::ifstream file(image, std::ios::binary);
  if (!file) return fail(exit_failed, arguments.image.empty() ? message_of_missing(image) : image + ": cannot be read");
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
  const auto flash = flash_of_uf2(std::vector<std::uint8_t>(bytes.begin(), bytes.end()));
  if (!flash) return fail(exit_bad_program, image + ": " + flash.error());
  if (flash->size() > flash_of_pico) {
    return fail(exit_bad_program,
                fmt::format("{}: {} bytes; a Pico has room for {}", image, flash->size(), flash_of_pico));
  }
  const auto drive = drive_of(arguments);
  if (!drive) return fail(exit_failed, drive.error());
  const fs::path target = *drive / "passo.uf2";
  fmt::print("{}: {} of {} bytes\n+ cp {} {}\n", image, flash->size(), flash_of_pico, image, target.string());
  if (arguments.dry_run) {
    fmt::print("Dry run: nothing was changed.\n");
    return exit_done;
  }
  if (const std::string wrong = copy_to_drive(bytes, target); !wrong.empty()) {
    return fail(exit_failed,
                fmt::format("{}: {}; the firmware may be incomplete: flash the board again", target.string(), wrong));
  }
  fmt::print("Done. The Pico restarts with the new firmware. To go back, copy another UF2 file to the drive.\n");
  return exit_done;
}

}  // namespace passo
