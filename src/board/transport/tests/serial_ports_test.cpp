#include "passo/transport/serial_ports.hpp"

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "kit/system_files.hpp"
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

namespace passo {
namespace {

namespace fs = std::filesystem;

// A computer's files, as the kernel shows them: an Uno, a CH340 behind a hub, the PC's own COM port and a console.
class SerialPorts : public testing::Test {
 protected:
  SerialPorts() {
    uno_ = files_.plug_in("ttyACM0", {.bus = "1-2",
                                      .vendor = "2341",
                                      .product = "0043",
                                      .manufacturer = "Arduino (www.arduino.cc)",
                                      .product_name = "Arduino Uno",
                                      .serial_number = "7543"});
    files_.name_lastingly("ttyACM0", "usb-Arduino_Uno_7543-if00");
    files_.plug_in(
        "ttyUSB0",
        {.bus = "1-3.1", .vendor = "1a86", .product = "7523", .product_name = "USB Serial", .is_converter = true});
    fs::create_directories(root_ / "sys/devices/pnp0/00:05/tty/ttyS0");
    fs::create_symlink("../../../00:05", root_ / "sys/devices/pnp0/00:05/tty/ttyS0/device");
    fs::create_symlink("../../devices/pnp0/00:05/tty/ttyS0", root_ / "sys/class/tty/ttyS0");
    fs::create_directories(root_ / "sys/class/tty/console");
    write("proc/cpuinfo", "");
  }
  ~SerialPorts() override { fs::remove_all(root_); }

  void write(const std::string& file, const std::string& text) const { files_.write(file, text); }
  SerialPortList list() const { return list_serial_ports(root_.string()); }
  SerialPort port(const std::string& name) const {
    for (const SerialPort& one : list().ports) {
      if (one.device == (root_ / "dev" / name).string()) return one;
    }
    ADD_FAILURE() << name << " is not listed";
    return {};
  }

  void unplug(const std::string& name) const {
    fs::remove(root_ / "sys/class/tty" / name);
    fs::remove(root_ / "dev" / name);
  }

  const fs::path root_ = fs::temp_directory_path() / ("passo-ports-" + std::to_string(getpid()));
  const test::SystemFiles files_{root_};
  std::string uno_;  // the folder of its USB device
};

TEST_F(SerialPorts, are_listed_with_what_the_device_says) {
  const SerialPortList found = list();
  ASSERT_EQ(found.ports.size(), 2U) << "a console and a port without USB are not listed";
  const SerialPort& uno = found.ports[0];
  EXPECT_EQ(uno.device, (root_ / "dev/ttyACM0").string());
  EXPECT_EQ(uno.lasting_name, (root_ / "dev/serial/by-id/usb-Arduino_Uno_7543-if00").string());
  EXPECT_EQ(uno.vendor, 0x2341);
  EXPECT_EQ(uno.product, 0x0043);
  EXPECT_EQ(uno.manufacturer, "Arduino (www.arduino.cc)");
  EXPECT_EQ(uno.product_name, "Arduino Uno");
  EXPECT_EQ(uno.serial_number, "7543");
  const SerialPort& converter = found.ports[1];
  EXPECT_EQ(converter.vendor, 0x1A86);
  EXPECT_EQ(converter.product, 0x7523);
  EXPECT_EQ(converter.lasting_name, converter.device) << "it has no link";
  EXPECT_EQ(converter.serial_number, "");
  EXPECT_TRUE(uno.users.empty());
  EXPECT_TRUE(converter.users.empty());
  EXPECT_TRUE(found.sees_all_programs);
}

TEST_F(SerialPorts, are_none_on_a_computer_without_them) {
  EXPECT_TRUE(list_serial_ports((root_ / "elsewhere").string()).ports.empty());
}

TEST_F(SerialPorts, are_in_use_by_the_programs_that_have_them_open) {
  files_.begin(812, "cncjs", "ttyUSB0");
  files_.begin(93, "bash");
  files_.begin(77, "minicom", "ttyUSB0");
  const std::vector<PortUser> users{{.process = 77, .program = "minicom"}, {.process = 812, .program = "cncjs"}};
  EXPECT_EQ(port("ttyUSB0").users, users);
  EXPECT_EQ(describe_users(port("ttyUSB0")), "in use by minicom (process 77), cncjs (process 812)");
  EXPECT_TRUE(port("ttyACM0").users.empty());
}

TEST_F(SerialPorts, are_in_use_by_whoever_opened_the_device_behind_a_link) {
  fs::remove(root_ / "dev/ttyACM0");
  write("elsewhere/terminal", "");
  fs::create_symlink(root_ / "elsewhere/terminal", root_ / "dev/ttyACM0");
  files_.begin(5, "candle");
  fs::create_symlink(root_ / "elsewhere/terminal", root_ / "proc/5/fd/3");
  EXPECT_EQ(describe_users(port("ttyACM0")), "in use by candle (process 5)");
}

// The open files of another user's program are secret; its locks and its name are not.
TEST_F(SerialPorts, are_in_use_by_a_program_that_locks_them) {
  files_.begin(4711, "octoprint");
  fs::remove_all(root_ / "proc/4711/fd");
  struct stat file {};
  ASSERT_EQ(stat((root_ / "dev/ttyACM0").c_str(), &file), 0);
  char row[128];
  std::snprintf(row, sizeof row, "2: FLOCK  ADVISORY  WRITE 4711 %02x:%02x:%llu 0 EOF\n", major(file.st_dev),
                minor(file.st_dev), static_cast<unsigned long long>(file.st_ino));
  write("proc/locks", "1: POSIX  ADVISORY  WRITE 812 00:1a:2 0 EOF\n" + std::string(row) + "3: nonsense");
  EXPECT_EQ(describe_users(port("ttyACM0")), "in use by octoprint (process 4711)");
  EXPECT_TRUE(port("ttyUSB0").users.empty());
  // In a container, processes outside it have no number.
  const std::string other = std::string(row).replace(std::string(row).find("4711"), 4, "-1");
  write("proc/locks", other);
  EXPECT_EQ(describe_users(port("ttyACM0")), "in use by another program");
}

TEST_F(SerialPorts, are_in_use_by_the_program_in_their_lock_file) {
  files_.begin(31, "picocom");
  write("var/lock/LCK..ttyUSB0", "        31\n");
  EXPECT_EQ(describe_users(port("ttyUSB0")), "in use by picocom (process 31)");
  // As kermit writes it.
  const std::int32_t number = 31;
  std::string bytes(sizeof number, '\0');
  std::memcpy(bytes.data(), &number, sizeof number);
  write("var/lock/LCK..ttyUSB0", bytes);
  EXPECT_EQ(describe_users(port("ttyUSB0")), "in use by picocom (process 31)");
  write("var/lock/LCK..ttyUSB0", "        32\n");
  EXPECT_TRUE(port("ttyUSB0").users.empty()) << "the program that wrote it has ended";
  write("var/lock/LCK..ttyUSB0", "whose?\n");
  EXPECT_EQ(describe_users(port("ttyUSB0")), "in use by another program");
}

TEST_F(SerialPorts, are_not_looked_for_in_a_pipe_that_stands_for_a_lock_file) {
  fs::create_directories(root_ / "var/lock");
  ASSERT_EQ(mkfifo((root_ / "var/lock/LCK..ttyUSB0").c_str(), 0600), 0);
  EXPECT_TRUE(port("ttyUSB0").users.empty());
}

TEST_F(SerialPorts, of_a_program_with_several_signs_have_one_user) {
  files_.begin(31, "picocom", "ttyUSB0");
  write("var/lock/LCK..ttyUSB0", "        31\n");
  EXPECT_EQ(describe_users(port("ttyUSB0")), "in use by picocom (process 31)");
}

TEST_F(SerialPorts, are_found_again_under_another_name) {
  const SerialPort before = port("ttyACM0");
  EXPECT_EQ(find_serial_port(list(), before.lasting_name)->device, before.device);
  EXPECT_EQ(find_returned_port(list(), before)->device, before.device);
  unplug("ttyACM0");
  EXPECT_EQ(find_returned_port(list(), before), nullptr);
  // Another Uno, and the same one at another socket.
  files_.plug_in("ttyACM1", {.bus = "1-4",
                             .vendor = "2341",
                             .product = "0043",
                             .manufacturer = "Arduino (www.arduino.cc)",
                             .product_name = "Arduino Uno",
                             .serial_number = "9999"});
  EXPECT_EQ(find_returned_port(list(), before), nullptr);
  files_.plug_in("ttyACM2", {.bus = "1-5",
                             .vendor = "2341",
                             .product = "0043",
                             .manufacturer = "Arduino (www.arduino.cc)",
                             .product_name = "Arduino Uno",
                             .serial_number = "7543"});
  const SerialPortList now = list();
  ASSERT_NE(find_returned_port(now, before), nullptr);
  EXPECT_EQ(find_returned_port(now, before)->device, (root_ / "dev/ttyACM2").string());
}

// A CH340 has no serial number: two of them cannot be told apart.
TEST_F(SerialPorts, are_not_guessed_among_devices_that_are_alike) {
  const SerialPort before = port("ttyUSB0");
  unplug("ttyUSB0");
  const test::SystemFiles::Usb twin{
      .bus = "1-6", .vendor = "1a86", .product = "7523", .product_name = "USB Serial", .is_converter = true};
  files_.plug_in("ttyUSB1", twin);
  const SerialPortList one = list();
  ASSERT_NE(find_returned_port(one, before), nullptr);
  files_.begin(812, "cncjs", "ttyUSB1");
  EXPECT_EQ(find_returned_port(list(), before), nullptr) << "another program drives it";
  fs::remove_all(root_ / "proc/812");
  test::SystemFiles::Usb other = twin;
  other.bus = "1-7";
  files_.plug_in("ttyUSB2", other);
  EXPECT_EQ(find_returned_port(list(), before), nullptr);
}

TEST_F(SerialPorts, may_be_busy_unnoticed_if_open_files_are_secret) {
  files_.begin(12, "ugs", "ttyUSB0");
  if (geteuid() == 0) GTEST_SKIP() << "the administrator may read everything";
  fs::permissions(root_ / "proc/12/fd", fs::perms::none);
  EXPECT_FALSE(list().sees_all_programs);
  fs::permissions(root_ / "proc/12/fd", fs::perms::owner_all);
}

TEST_F(SerialPorts, with_hostile_texts_are_listed_with_printable_ones) {
  write(uno_ + "/product", "\x1b[2J\xff Uno \xe2\x80\xaetxt.exe\n");
  write(uno_ + "/manufacturer", std::string(100'000, 'A'));
  write(uno_ + "/idVendor", "99999\n");
  write(uno_ + "/serial", std::string("12\0\0", 4));
  const SerialPort uno = port("ttyACM0");
  EXPECT_EQ(uno.product_name, "[2J Uno txt.exe");
  EXPECT_EQ(uno.manufacturer, std::string(longest_port_text, 'A'));
  EXPECT_EQ(uno.vendor, 0);
  EXPECT_EQ(uno.serial_number, "12");
}

TEST_F(SerialPorts, are_bounded_in_number) {
  for (int i = 1; i < 64; ++i) {
    const std::string n = std::to_string(i);
    files_.plug_in("ttyACM" + n, {.bus = "2-" + n, .vendor = "16c0", .product = "0483"});
  }
  EXPECT_EQ(list().ports.size(), most_serial_ports);
}

// A link that leads to itself, and one to nowhere.
TEST_F(SerialPorts, with_broken_links_are_passed_over) {
  fs::create_directories(root_ / "sys/class/tty/ttyUSB8");
  fs::create_symlink("device", root_ / "sys/class/tty/ttyUSB8/device");
  fs::create_symlink("../../devices/none", root_ / "sys/class/tty/ttyUSB9");
  EXPECT_EQ(list().ports.size(), 2U);
}

TEST(SerialPortsOfThisComputer, can_be_listed) {
  EXPECT_LE(list_serial_ports().ports.size(), most_serial_ports);
}

}  // namespace
}  // namespace passo
