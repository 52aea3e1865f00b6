#include "passo/transport/serial_line.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fcntl.h>
#include <linux/serial.h>
#include <linux/tty_flags.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

namespace passo {
namespace {

struct Speed {
  unsigned baud;
  speed_t code;
};
constexpr std::array speeds = {Speed{9600, B9600},         Speed{19200, B19200},       Speed{38400, B38400},
                               Speed{57600, B57600},       Speed{115200, B115200},     Speed{230400, B230400},
                               Speed{460800, B460800},     Speed{500'000, B500000},    Speed{576'000, B576000},
                               Speed{921'600, B921600},    Speed{1'000'000, B1000000}, Speed{1'152'000, B1152000},
                               Speed{1'500'000, B1500000}, Speed{2'000'000, B2000000}};

// Eight raw bits, without flow control. No hang-up at the end: closing the line does not reset an Arduino.
bool set_raw(int descriptor, speed_t speed) {
  termios settings{};
  if (tcgetattr(descriptor, &settings) != 0) return false;
  cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cflag &= ~static_cast<tcflag_t>(HUPCL | CSTOPB | CRTSCTS);
  settings.c_cc[VMIN] = 0;
  settings.c_cc[VTIME] = 0;
  if (cfsetspeed(&settings, speed) != 0 || tcsetattr(descriptor, TCSANOW, &settings) != 0) return false;
  return tcflush(descriptor, TCIOFLUSH) == 0;
}

std::optional<int> latency_told_by(const std::filesystem::path& timer) {
  std::ifstream file(timer);
  int milliseconds = 0;
  return file >> milliseconds ? std::optional(milliseconds) : std::nullopt;
}

}  // namespace

std::optional<int> hurry_adapter(int descriptor, const std::string& device, const std::string& sys) {
  // Whoever may open the line may set this flag.
  serial_struct settings{};
  if (ioctl(descriptor, TIOCGSERIAL, &settings) == 0 &&
      (static_cast<unsigned>(settings.flags) & ASYNC_LOW_LATENCY) == 0) {
    settings.flags |= static_cast<int>(ASYNC_LOW_LATENCY);
    static_cast<void>(ioctl(descriptor, TIOCSSERIAL, &settings));
  }
  // An older kernel needs the number, and allows it to the administrator only.
  std::error_code none;
  const auto name = std::filesystem::weakly_canonical(device, none).filename();
  const std::filesystem::path timer = std::filesystem::path(sys) / "class/tty" / name / "device/latency_timer";
  if (latency_told_by(timer).value_or(1) > 1) std::ofstream(timer) << 1 << std::flush;
  return latency_told_by(timer);
}

Result<int, std::string> open_serial_line(const std::string& device, unsigned baud) {
  const auto* speed = std::find_if(speeds.begin(), speeds.end(), [&](const Speed& one) { return one.baud == baud; });
  if (speed == speeds.end()) {
    return Failure{std::to_string(baud) + " baud is not a supported baud rate; try 115200, 500000 or 1000000"};
  }
  const int descriptor = open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) {
    const bool denied = errno == EACCES;
    return Failure{device + ": " + std::strerror(errno) +
                   (denied ? " (only members of the group dialout have access: adduser NAME dialout)" : "")};
  }
  // Two programs on one line would each get half of the answers.
  if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    close(descriptor);
    return Failure{device + ": in use by another program"};
  }
  if (set_raw(descriptor, speed->code)) {
    static_cast<void>(hurry_adapter(descriptor, device));
    return descriptor;
  }
  std::string message = device + ": not a serial port: " + std::strerror(errno);
  close(descriptor);
  return Failure{std::move(message)};
}

}  // namespace passo
