// SystemFiles: files of a computer's system in a folder, for list_serial_ports() and for the option --system.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace passo::test {

class SystemFiles {
 public:
  explicit SystemFiles(std::filesystem::path root) : root_(std::move(root)) {
    std::filesystem::create_directories(root_ / "sys/class/tty");
    std::filesystem::create_directories(root_ / "dev/serial/by-id");
    write("proc/locks", "");
  }

  const std::filesystem::path& root() const { return root_; }
  std::string path(const std::string& file) const { return (root_ / file).string(); }
  void write(const std::string& file, const std::string& text) const {
    std::filesystem::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file, std::ios::binary) << text;
  }

  struct Usb {
    std::string bus;  // "1-2", where it is plugged in
    std::string vendor;
    std::string product;
    std::string manufacturer = {};
    std::string product_name = {};
    std::string serial_number = {};
    bool is_converter = false;  // it has a folder of its own between the tty and the USB interface
  };
  // Plugs a device in. Returns the folder with its texts.
  std::string plug_in(const std::string& name, const Usb& usb) const {
    const std::string folder = "sys/devices/pci0000:00/0000:00:14.0/usb1/" + usb.bus;
    write(folder + "/idVendor", usb.vendor + "\n");
    write(folder + "/idProduct", usb.product + "\n");
    if (!usb.manufacturer.empty()) write(folder + "/manufacturer", usb.manufacturer + "\n");
    if (!usb.product_name.empty()) write(folder + "/product", usb.product_name + "\n");
    if (!usb.serial_number.empty()) write(folder + "/serial", usb.serial_number + "\n");
    const std::string below = usb.bus + ":1.0";
    const std::filesystem::path owner = root_ / folder / below / (usb.is_converter ? name : "");
    const std::filesystem::path tty = (usb.is_converter ? owner : root_ / folder / below) / "tty" / name;
    std::filesystem::create_directories(tty);
    std::filesystem::create_symlink("../../../" + (usb.is_converter ? name : below), tty / "device");
    std::filesystem::create_symlink(tty, root_ / "sys/class/tty" / name);
    write("dev/" + name, "");
    return folder;
  }
  void name_lastingly(const std::string& name, const std::string& lasting) const {
    std::filesystem::create_symlink("../../" + name, root_ / "dev/serial/by-id" / lasting);
  }
  // `opens`: the name of a port; empty: none.
  void begin(int process, const std::string& name, const std::string& opens = "") const {
    const std::string folder = "proc/" + std::to_string(process);
    write(folder + "/comm", name + "\n");
    std::filesystem::create_directories(root_ / folder / "fd");
    std::filesystem::create_symlink("/dev/null", root_ / folder / "fd/0");
    if (!opens.empty()) std::filesystem::create_symlink(root_ / "dev" / opens, root_ / folder / "fd/7");
  }

 private:
  std::filesystem::path root_;
};

}  // namespace passo::test
