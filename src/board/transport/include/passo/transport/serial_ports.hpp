// list_serial_ports: the USB serial ports of this computer, and the programs that use them, without opening a port.
//
// Opening a serial port restarts an Arduino, also in the middle of another program's job. Therefore all that is known
// here comes from files of the kernel and of other programs:
//
//   /sys/class/tty/NAME/device   the USB device: its ids and its texts
//   /dev/serial/by-id            names that stay the same wherever a board is plugged in
//   /proc/PID/fd                 open files. Those of other users' programs can be read by the administrator only
//   /proc/locks                  locks (flock), of all programs
//   /var/lock/LCK..NAME          lock files, of all programs that write one
//
// All of these are untrusted: texts are printable UTF-8 and have at most `longest_port_text` bytes, and there are at
// most `most_serial_ports` ports.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace passo {

inline constexpr std::size_t most_serial_ports = 64;
inline constexpr std::size_t longest_port_text = 120;  // bytes

// A program that uses a port.
struct PortUser {
  int process = 0;      // 0: unknown
  std::string program;  // the name of its process; empty: unknown

  bool operator==(const PortUser&) const = default;
};

struct SerialPort {
  std::string device;        // "/dev/ttyACM0"
  std::string lasting_name;  // the link in /dev/serial/by-id; the device if there is none
  std::uint16_t vendor = 0;  // USB ids
  std::uint16_t product = 0;
  std::string manufacturer;  // texts of the device; may be empty
  std::string product_name;
  std::string serial_number;
  std::vector<PortUser> users;  // in the order of their process numbers; empty: none is known
};

struct SerialPortList {
  std::vector<SerialPort> ports;   // in the order of their devices
  bool sees_all_programs = false;  // false: open files of some programs cannot be read, so a port may be busy unnoticed
};

// `root` comes before the path of each file that is read, and of each device in the result. Tests have their own files
// there; empty: the computer's.
SerialPortList list_serial_ports(const std::string& root = "");

// Returns the port of a device or of one of its links; null if it is not listed.
const SerialPort* find_serial_port(const SerialPortList& list, const std::string& device);

// A device that was unplugged may return under another name: ttyUSB0 as ttyUSB1. Returns the port at which the device
// of `before` is now, by its USB ids, its serial number and its texts. If several ports could be it, the one with the
// earlier name is it; null if there is none, or if the only others are in use.
const SerialPort* find_returned_port(const SerialPortList& list, const SerialPort& before);

// Returns "in use by cncjs (process 4711)". The port has a user.
std::string describe_users(const SerialPort& port);

}  // namespace passo
