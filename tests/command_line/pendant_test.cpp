// A pendant at `passo serve`: a pseudo-terminal stands for /dev/hidraw0, in a folder with system files.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "kit/served_http.hpp"
#include <fcntl.h>
#include <gmock/gmock.h>
#include <termios.h>

namespace passo::test {
namespace {

namespace fs = std::filesystem;

bool is_connected(const nlohmann::json& status) {
  const nlohmann::json& pendant = status["pendant"];
  return pendant.is_object() && pendant["connected"] == true;
}

class Pendants : public ServedHttp {
 protected:
  ~Pendants() override { pull(); }

  std::string system() const { return path("system"); }
  std::string device() const { return system() + "/dev/hidraw0"; }
  void write_uevent(const std::string& ids) const {
    const fs::path folder = fs::path(system()) / "sys/class/hidraw/hidraw0/device";
    fs::create_directories(folder);
    fs::create_directories(fs::path(system()) / "dev");
    write("system/sys/class/hidraw/hidraw0/device/uevent", "HID_ID=0003:" + ids + "\nHID_NAME=Test wheel\n");
  }
  // Plugs in a WHB04B.
  void plug_in() {
    pendant_ = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    ASSERT_GE(pendant_, 0);
    ASSERT_EQ(grantpt(pendant_), 0);
    ASSERT_EQ(unlockpt(pendant_), 0);
    termios raw{};
    ASSERT_EQ(tcgetattr(pendant_, &raw), 0);
    cfmakeraw(&raw);
    ASSERT_EQ(tcsetattr(pendant_, TCSANOW, &raw), 0);
    write_uevent("000010CE:0000EB93");
    fs::remove(device());
    fs::create_symlink(ptsname(pendant_), device());
  }
  void pull() {
    if (pendant_ < 0) return;
    fs::remove_all(system());
    close(pendant_);
    pendant_ = -1;
  }
  void send(int key, int feed, int axis, int wheel) const {
    const unsigned char report[8] = {4,
                                     1,
                                     static_cast<unsigned char>(key),
                                     0,
                                     static_cast<unsigned char>(feed),
                                     static_cast<unsigned char>(axis),
                                     static_cast<unsigned char>(wheel),
                                     1};
    ASSERT_EQ(::write(pendant_, report, sizeof report), static_cast<ssize_t>(sizeof report));
  }
  nlohmann::json status() const {
    const std::string answer = ask("GET", "/api/v1/status");
    return nlohmann::json::parse(answer.substr(answer.find("\r\n\r\n") + 4), nullptr, false);
  }
  // Waits until the status is so.
  template <class Condition>
  bool comes(Condition condition) const {
    for (int i = 0; i < 500; ++i) {
      if (condition(status())) return true;
      usleep(20'000);
    }
    return false;
  }

 private:
  int pendant_ = -1;
};
using PendantServed = Pendants;

TEST_F(Pendants, are_listed) {
  write_uevent("000010CE:0000EB93");
  const auto list = passo("pendant list --system " + system());
  EXPECT_EQ(list.code, 0);
  EXPECT_EQ(list.out, "hidraw:" + device() + "  10ce:eb93  Test wheel  (pendant: XHC WHB04B)\n");
  const auto json = nlohmann::json::parse(passo("pendant list --json --system " + system()).out);
  EXPECT_EQ(json[0]["pendant"], "XHC WHB04B");
  write_uevent("0000046D:0000C52B");
  EXPECT_EQ(nlohmann::json::parse(passo("pendant list --json --system " + system()).out)[0]["pendant"], nullptr);
}

TEST_F(Pendants, that_are_wrong_are_refused_with_the_reason) {
  EXPECT_THAT(passo("serve --check --pendant mouse").err, testing::HasSubstr("[pendant.name]"));
  EXPECT_EQ(passo("serve --check --pendant mouse").code, 2);
  EXPECT_THAT(passo("serve --check --pendant auto --grbl-tcp 127.0.0.1:0").err, testing::HasSubstr("[serve.pendant]"));
  fs::create_directories(path("nothing"));
  EXPECT_THAT(passo("pendant watch --system " + path("nothing")).err, testing::HasSubstr("[pendant.none]"));
  const std::string table = write("mine.toml",
                                  "name = \"Mine\"\n[usb]\nvendor = 1\nproduct = 2\n[report]\nlength = 4\n"
                                  "[keys]\nbit_bytes = [9]\n");
  const auto wrong = passo("pendant watch " + table);
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.err, testing::HasSubstr("mine.toml:8:13"));
  EXPECT_THAT(wrong.err, testing::HasSubstr("[pendant.wrong-list]"));
}

TEST_F(Pendants, at_a_board_without_pins_for_them_are_refused_with_the_place) {
  std::ifstream example(PASSO_SOURCE_DIR "/examples/machines/uno.toml");
  const std::string machine(std::istreambuf_iterator<char>(example), {});
  const std::string file = write("wheel.toml", machine + "\n[handwheel]\n");
  const auto refused = passo("serve --http 127.0.0.1:0 --board sim:uno -m " + file);
  EXPECT_EQ(refused.code, 3) << refused.err;
  EXPECT_THAT(refused.err, testing::HasSubstr("wheel.toml:"));
  EXPECT_THAT(refused.err, testing::HasSubstr("the board sim:uno has no pins for a handwheel [board.no-handwheel]"));
}

TEST_F(Pendants, are_watched) {
  plug_in();
  send(0, 0x0E, 0x12, 0);
  send(2, 0x0E, 0x12, 3);
  const auto seen = passo("pendant watch --count 2 --system " + system());
  EXPECT_EQ(seen.code, 0);
  EXPECT_EQ(seen.out,
            "04 01 00 00 0e 12 00 01   axis Y, step 0.01, 5 %\n"
            "04 01 02 00 0e 12 03 01   key Stop pressed, wheel +3\n");
}

TEST_F(PendantServed, jogs_until_its_cable_is_pulled_and_again_when_it_is_back) {
  fs::create_directories(system());
  serve({"--pendant", "auto", "--system", system()});
  EXPECT_TRUE(comes([](const auto& now) { return now["pendant"].is_null(); }));
  plug_in();
  ASSERT_TRUE(comes([](const auto& now) { return is_connected(now); }));
  send(0, 0x10, 0x11, 0);
  send(0, 0x10, 0x11, 3);
  ASSERT_TRUE(comes([](const auto& now) { return now["state"] == "Idle" && now["place"]["x"] > 2.99; })) << status();
  EXPECT_NEAR(status()["place"]["x"].get<double>(), 3, 0.01);
  EXPECT_EQ(status()["pendant"]["axis"], "x");
  // Continuous, at full speed, and then gone in the middle of it.
  send(0x0E, 0x1B, 0x11, 0);
  for (int i = 0; i < 25; ++i) {
    send(0, 0x1B, 0x11, 1);
    usleep(20'000);
  }
  pull();
  ASSERT_TRUE(comes([](const auto& now) { return now["state"] == "Idle" && !is_connected(now); }));
  const double end = status()["place"]["x"];
  EXPECT_GT(end, 5);
  plug_in();
  ASSERT_TRUE(comes([](const auto& now) { return is_connected(now); }));
  EXPECT_TRUE(comes([](const auto& now) { return now["owner"]["kind"] == "nobody"; }));
  EXPECT_EQ(status()["place"]["x"], end);
}

}  // namespace
}  // namespace passo::test
