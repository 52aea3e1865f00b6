#include "passo/transport/serial_line.hpp"

#include <filesystem>
#include <fstream>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace passo {
namespace {

namespace fs = std::filesystem;

// A sysfs with one FTDI adapter at ttyUSB7. The line itself is something whose driver knows nothing of latency.
class SerialAdapter : public testing::Test {
 protected:
  SerialAdapter() {
    fs::create_directories(timer_.parent_path());
    std::ofstream(timer_) << "16\n";
  }
  ~SerialAdapter() override {
    fs::remove_all(sys_);
    close(line_);
  }
  int told() const {
    int milliseconds = 0;
    std::ifstream(timer_) >> milliseconds;
    return milliseconds;
  }

  fs::path sys_ = fs::temp_directory_path() / ("passo-sys-" + std::to_string(getpid()));
  fs::path timer_ = sys_ / "class/tty/ttyUSB7/device/latency_timer";
  int line_ = open("/dev/null", O_RDWR | O_CLOEXEC);
};

TEST_F(SerialAdapter, of_ftdi_is_told_to_wait_a_millisecond) {
  EXPECT_EQ(hurry_adapter(line_, "/dev/ttyUSB7", sys_.string()), 1);
  EXPECT_EQ(told(), 1);
  EXPECT_EQ(hurry_adapter(line_, "/dev/ttyUSB7", sys_.string()), 1) << "once more changes nothing";
}

TEST_F(SerialAdapter, is_found_by_its_link_too) {
  const fs::path link = sys_ / "usb-FTDI_FT232R-if00-port0";
  fs::create_symlink(sys_ / "ttyUSB7", link);
  std::ofstream(sys_ / "ttyUSB7") << "";
  EXPECT_EQ(hurry_adapter(line_, link.string(), sys_.string()), 1);
  EXPECT_EQ(told(), 1);
}

TEST_F(SerialAdapter, of_another_kind_is_left_as_it_is) {
  EXPECT_EQ(hurry_adapter(line_, "/dev/ttyACM0", sys_.string()), std::nullopt);
  EXPECT_EQ(told(), 16);
}

TEST_F(SerialAdapter, tells_what_it_still_does_where_that_is_not_allowed) {
  if (geteuid() == 0) GTEST_SKIP() << "the administrator may write everything";
  fs::permissions(timer_, fs::perms::owner_read);
  EXPECT_EQ(hurry_adapter(line_, "/dev/ttyUSB7", sys_.string()), 16);
}

}  // namespace
}  // namespace passo
