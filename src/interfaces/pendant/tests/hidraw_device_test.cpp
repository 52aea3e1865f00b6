#include <array>
#include <filesystem>
#include <fstream>
#include <string>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include "passo/pendant/hid_devices.hpp"
#include "passo/pendant/pendant_device.hpp"
#include "passo/pendant/pendant_finder.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;

// The computer's end and the pendant's end.
std::array<int, 2> connected_pair() {
  std::array<int, 2> ends{};
  EXPECT_EQ(socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK | SOCK_CLOEXEC, 0, ends.data()), 0);
  return ends;
}

TEST(HidrawDevice, reads_reports_until_it_is_unplugged) {
  const auto ends = connected_pair();
  HidrawDevice device(ends[0], 3, false);
  PendantDevice::Report report;
  EXPECT_EQ(device.read(report), PendantDevice::Read::nothing);
  ASSERT_EQ(write(ends[1], "abc", 3), 3);
  ASSERT_EQ(write(ends[1], "d", 1), 1);
  EXPECT_EQ(device.read(report), PendantDevice::Read::report);
  EXPECT_THAT(report, testing::ElementsAre('a', 'b', 'c'));
  EXPECT_EQ(device.read(report), PendantDevice::Read::report);
  EXPECT_THAT(report, testing::ElementsAre('d'));
  EXPECT_EQ(device.read(report), PendantDevice::Read::nothing);
  close(ends[1]);
  EXPECT_EQ(device.read(report), PendantDevice::Read::gone);
}

TEST(HidrawDevice, writes_the_newest_reports_to_the_display) {
  const auto ends = connected_pair();
  HidrawDevice device(ends[0], 3, false);
  device.show({{6, 1}, {6, 2}});
  std::array<std::uint8_t, 8> bytes{};
  const auto receive = [&] {
    for (int i = 0; i < 500; ++i) {
      if (const ssize_t count = read(ends[1], bytes.data(), bytes.size()); count > 0) return static_cast<int>(bytes[1]);
      usleep(10'000);
    }
    return -1;
  };
  EXPECT_EQ(receive(), 1);
  EXPECT_EQ(receive(), 2);
  close(ends[1]);
}

TEST(HidrawDevice, says_why_it_cannot_be_opened) {
  const auto device = HidrawDevice::open("/no/such/device", 3, false);
  ASSERT_FALSE(device);
  EXPECT_EQ(device.error(), "/no/such/device cannot be opened: No such file or directory");
}

// The files of a computer's system with some HID devices.
class HidDevices : public testing::Test {
 protected:
  HidDevices() { fs::remove_all(root_); }
  ~HidDevices() override { fs::remove_all(root_); }

  void plug_in(const std::string& name, const std::string& uevent) const {
    const fs::path folder = root_ / "sys/class/hidraw" / name / "device";
    fs::create_directories(folder);
    std::ofstream(folder / "uevent") << uevent;
  }
  const fs::path root_ = fs::path(testing::TempDir()) / ("passo_hid_" + std::to_string(getpid()));
};

TEST_F(HidDevices, are_listed_with_their_ids_and_names) {
  plug_in("hidraw10", "DRIVER=hid-generic\nHID_ID=0003:00000B33:00000020\nHID_NAME=Contour Design ShuttleXpress\n");
  plug_in("hidraw2", "HID_ID=0003:000010CE:0000EB93\nHID_NAME=\x1b[31mKTURT.LTD \xE2\x80\xAE receiver\n");
  plug_in("hidraw3", "HID_ID=0003:0000\n");
  plug_in("hidraw4", "HID_ID=0003:FFFFFFFFF:0\nHID_NAME=large\n");
  plug_in("hidraw5", std::string(10'000, 'x'));
  const auto all = list_hid_devices(root_.string());
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].device, (root_ / "dev/hidraw2").string());
  EXPECT_EQ(all[0].vendor, 0x10CE);
  EXPECT_EQ(all[0].name, "[31mKTURT.LTD  receiver");
  EXPECT_EQ(all[1].name, "Contour Design ShuttleXpress");
  EXPECT_TRUE(list_hid_devices((root_ / "none").string()).empty());
}

TEST_F(HidDevices, are_found_by_table_or_device) {
  plug_in("hidraw0", "HID_ID=0003:0000046D:0000C52B\nHID_NAME=Mouse\n");
  plug_in("hidraw1", "HID_ID=0003:00000B33:00000020\nHID_NAME=ShuttleXpress\n");
  const std::string mine = (root_ / "mine.toml").string();
  std::ofstream(mine) << "name = \"Mine\"\n[usb]\nvendor = 0x046D\nproduct = 0xC52B\n[report]\nlength = 8\n";
  const auto found = [&](const std::string& wanted) {
    Diagnostics diagnostics;
    const auto finder = PendantFinder::make(wanted, root_.string(), diagnostics);
    if (!finder) return diagnostics.all().front().code;
    const auto pendant = finder->find();
    if (!pendant) return std::string("none");
    return fs::path(pendant->device.device).filename().string() + " " +
           (pendant->table != nullptr ? pendant->table->name : "unknown");
  };
  EXPECT_EQ(found("auto"), "hidraw1 Contour ShuttleXpress");
  EXPECT_EQ(found(mine), "hidraw0 Mine");
  EXPECT_EQ(found("hidraw:" + (root_ / "dev/hidraw0").string()), "hidraw0 unknown");
  EXPECT_EQ(found("hidraw:" + (root_ / "dev/hidraw7").string()), "none");
  EXPECT_EQ(found("hidraw:"), "pendant.name");
  EXPECT_EQ(found("mouse"), "pendant.name");
  EXPECT_EQ(found((root_ / "other.toml").string()), "pendant.file");
}

}  // namespace
}  // namespace passo
