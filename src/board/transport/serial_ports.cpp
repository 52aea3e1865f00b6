#include "passo/transport/serial_ports.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string_view>
#include <system_error>

#include <sys/stat.h>
#include <sys/sysmacros.h>

#include "passo/base/trimmed.hpp"
#include "passo/base/utf8.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_read = 64 * 1024;  // bytes of one file
constexpr int highest_parents = 6;               // from a tty to its USB device

std::string start_of(const fs::path& file, std::size_t most) {
  std::ifstream in(file, std::ios::binary);
  std::string text(most, '\0');
  in.read(text.data(), static_cast<std::streamsize>(most));
  text.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  return text;
}

// What a device or a program says about itself may be anything.
std::string printable_text(std::string_view text) {
  std::string good;
  text = trimmed(text, std::string_view(" \t\r\n\0", 5));
  while (!text.empty()) {
    const CodePoint point = first_code_point(text);
    const std::size_t length = std::max<std::size_t>(point.length, 1);
    const bool is_control = point.value < 0x20 || (point.value >= 0x7F && point.value < 0xA0);
    // Marks that change the direction of the text around them hide what follows.
    const bool is_format = (point.value >= 0x200B && point.value <= 0x200F) ||
                           (point.value >= 0x2028 && point.value <= 0x202E) ||
                           (point.value >= 0x2066 && point.value <= 0x2069) || point.value == 0xFEFF;
    if (point.length > 0 && !is_control && !is_format) good += text.substr(0, length);
    text.remove_prefix(length);
  }
  return std::string(cut_at_character(good, longest_port_text));
}

// Nothing: the folder cannot be read; `error` says why.
std::vector<fs::path> entries_of(const fs::path& folder, std::error_code& error) {
  std::vector<fs::path> entries;
  auto entry = fs::directory_iterator(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) entries.push_back(entry->path());
  return entries;
}

std::string text_in(const fs::path& file) {
  return printable_text(start_of(file, 4 * longest_port_text));
}

template <class Number>
std::optional<Number> number_in(std::string_view text, int base = 10) {
  text = trimmed(text, " \t\r\n");
  Number number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, base);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

// The folder of the USB device to which a tty belongs. Empty: it is not a USB port.
fs::path usb_device_of(const fs::path& tty) {
  std::error_code none;
  fs::path folder = fs::canonical(tty / "device", none);
  for (int i = 0; !none && i < highest_parents && folder.has_relative_path(); ++i, folder = folder.parent_path()) {
    if (fs::exists(folder / "idVendor", none)) return folder;
  }
  return {};
}

// The links in by-id, by the device to which they lead.
std::map<std::string, std::string> lasting_names(const fs::path& root) {
  std::map<std::string, std::string> names;
  std::error_code none;
  for (const fs::path& link : entries_of(root / "dev/serial/by-id", none)) {
    // One step only: in tests the device is a link, too.
    std::string& name = names[fs::read_symlink(link, none).filename().string()];
    if (name.empty() || link.string() < name) name = link.string();
  }
  return names;
}

std::optional<SerialPort> read_port(const fs::path& root, const fs::path& tty,
                                    const std::map<std::string, std::string>& names) {
  const fs::path usb = usb_device_of(tty);
  if (usb.empty()) return {};
  SerialPort port;
  port.device = (root / "dev" / tty.filename()).string();
  const auto name = names.find(tty.filename().string());
  port.lasting_name = name == names.end() ? port.device : name->second;
  port.vendor = number_in<std::uint16_t>(start_of(usb / "idVendor", 16), 16).value_or(0);
  port.product = number_in<std::uint16_t>(start_of(usb / "idProduct", 16), 16).value_or(0);
  port.manufacturer = text_in(usb / "manufacturer");
  port.product_name = text_in(usb / "product");
  port.serial_number = text_in(usb / "serial");
  return port;
}

// The processes of the computer, and their names.
class ProcessFolder {
 public:
  explicit ProcessFolder(const fs::path& root) : folder_(root / "proc") {}

  bool runs(int process) const {
    std::error_code none;
    return process > 0 && fs::exists(folder_ / std::to_string(process), none);
  }
  std::string name_of(int process) const { return text_in(folder_ / std::to_string(process) / "comm"); }
  std::string locks() const { return start_of(folder_ / "locks", longest_read); }

  // Calls `found` with each process and the path of each of its open files. Returns false if some cannot be read.
  template <class Found>
  bool for_each_file(const Found& found) const {
    bool sees_all = true;
    std::error_code error;
    for (const fs::path& entry : entries_of(folder_, error)) {
      const auto process = number_in<int>(entry.filename().string());
      if (!process) continue;
      const std::vector<fs::path> links = entries_of(entry / "fd", error);
      // A process that has ended meanwhile uses nothing.
      if (error == std::errc::permission_denied) sees_all = false;
      for (const fs::path& link : links) {
        const fs::path file = fs::read_symlink(link, error);
        if (!error) found(*process, file);
      }
    }
    return sees_all;
  }

 private:
  fs::path folder_;
};

void add_user(SerialPort& port, int process, const ProcessFolder& processes) {
  std::vector<PortUser>& users = port.users;
  const auto place = std::lower_bound(users.begin(), users.end(), process,
                                      [](const PortUser& user, int number) { return user.process < number; });
  if (place != users.end() && place->process == process) return;
  users.insert(place, {.process = process, .program = process > 0 ? processes.name_of(process) : std::string()});
}

bool add_those_with_open_files(std::vector<SerialPort>& ports, const ProcessFolder& processes) {
  std::map<std::string, SerialPort*> by_device;
  for (SerialPort& port : ports) {
    std::error_code none;
    by_device[port.device] = &port;
    const fs::path real = fs::canonical(port.device, none);
    if (!none) by_device[real.string()] = &port;
  }
  return processes.for_each_file([&](int process, const fs::path& file) {
    const auto port = by_device.find(file.string());
    if (port != by_device.end()) add_user(*port->second, process, processes);
  });
}

// A row: "1: FLOCK  ADVISORY  WRITE 4711 00:05:345 0 EOF", with the device in hexadecimal and the file's number. In a
// container, the process may have the number 0 or -1: unknown.
void add_those_with_locks(std::vector<SerialPort>& ports, const ProcessFolder& processes) {
  const std::string locks = processes.locks();
  for (SerialPort& port : ports) {
    struct stat file {};
    if (stat(port.device.c_str(), &file) != 0) continue;
    std::array<char, 64> wanted{};
    std::snprintf(wanted.data(), wanted.size(), "%02x:%02x:%llu", major(file.st_dev), minor(file.st_dev),
                  static_cast<unsigned long long>(file.st_ino));
    for (std::string_view left = locks; !left.empty();) {
      const std::string_view row = left.substr(0, left.find('\n'));
      left.remove_prefix(std::min(left.size(), row.size() + 1));
      const std::size_t at = row.find(std::string(" ") + wanted.data() + " ");
      if (at == std::string_view::npos) continue;
      const std::string_view before = row.substr(0, at);
      const auto process = number_in<int>(before.substr(before.rfind(' ') + 1));
      add_user(port, std::max(process.value_or(0), 0), processes);
    }
  }
}

// The process in a lock file: decimal, as most programs write it, or the four bytes of a number.
int process_in(const std::string& text) {
  if (const auto number = number_in<int>(text.substr(0, text.find('\n')))) return *number;
  int number = 0;
  if (text.size() == sizeof number) std::memcpy(&number, text.data(), sizeof number);
  return number;
}

void add_those_with_lock_files(std::vector<SerialPort>& ports, const fs::path& root, const ProcessFolder& processes) {
  for (SerialPort& port : ports) {
    const fs::path file = root / "var/lock" / ("LCK.." + fs::path(port.device).filename().string());
    std::error_code none;
    // Any user may write into this folder. To open a pipe there would wait for its other end.
    if (!fs::is_regular_file(file, none)) continue;
    const int process = process_in(start_of(file, 64));
    // A program that was killed leaves its lock file. One that cannot be read may be anybody's.
    if (process > 0 && !processes.runs(process)) continue;
    add_user(port, std::max(process, 0), processes);
  }
}

}  // namespace

SerialPortList list_serial_ports(const std::string& root) {
  const fs::path top = root.empty() ? fs::path("/") : fs::path(root);
  SerialPortList list;
  const auto names = lasting_names(top);
  std::error_code none;
  for (const fs::path& tty : entries_of(top / "sys/class/tty", none)) {
    if (list.ports.size() == most_serial_ports) break;
    if (auto port = read_port(top, tty, names)) list.ports.push_back(std::move(*port));
  }
  std::sort(list.ports.begin(), list.ports.end(),
            [](const SerialPort& one, const SerialPort& other) { return one.device < other.device; });
  const ProcessFolder processes(top);
  list.sees_all_programs = add_those_with_open_files(list.ports, processes);
  add_those_with_locks(list.ports, processes);
  add_those_with_lock_files(list.ports, top, processes);
  return list;
}

const SerialPort* find_serial_port(const SerialPortList& list, const std::string& device) {
  std::error_code none;
  const fs::path real = fs::weakly_canonical(device, none);
  const auto found = std::find_if(list.ports.begin(), list.ports.end(), [&](const SerialPort& one) {
    return one.device == device || one.lasting_name == device || (!none && real == one.device);
  });
  return found == list.ports.end() ? nullptr : &*found;
}

const SerialPort* find_returned_port(const SerialPortList& list, const SerialPort& before) {
  const SerialPort* found = nullptr;
  bool is_one_of_several = false;
  for (const SerialPort& one : list.ports) {
    const bool is_alike = one.vendor == before.vendor && one.product == before.product &&
                          one.serial_number == before.serial_number && one.product_name == before.product_name &&
                          one.manufacturer == before.manufacturer;
    if (!is_alike) continue;
    if (one.device == before.device) return &one;
    if (!one.users.empty()) continue;
    is_one_of_several = found != nullptr;
    found = &one;
  }
  return is_one_of_several ? nullptr : found;
}

std::string describe_users(const SerialPort& port) {
  std::string words;
  for (const PortUser& user : port.users) {
    words += words.empty() ? "in use by " : ", ";
    words += user.program.empty() ? "another program" : user.program;
    if (user.process > 0) words += " (process " + std::to_string(user.process) + ")";
  }
  return words;
}

}  // namespace passo
