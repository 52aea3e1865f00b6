// list_hid_devices: the HID devices of this computer that Linux offers as hidraw, without opening one.
//
//   /sys/class/hidraw/NAME/device/uevent   HID_ID=0003:000010CE:0000EB93, HID_NAME=…, HID_UNIQ=…
//
// The files are untrusted: names are printable and have at most `longest_hid_name` bytes, and there are at most
// `most_hid_devices` devices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace passo {

inline constexpr std::size_t most_hid_devices = 64;
inline constexpr std::size_t longest_hid_name = 80;  // bytes

struct HidDevice {
  std::string device;  // "/dev/hidraw3"
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  std::string name;  // may be empty
};

// In the order of their names. `root` comes before the path of each file, as in list_serial_ports().
std::vector<HidDevice> list_hid_devices(const std::string& root = "");

}  // namespace passo
