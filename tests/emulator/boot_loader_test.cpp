// The Uno's real boot loader (optiboot) on the emulated chip, and the real avrdude at the other end of a
// pseudo-terminal: what `passo board flash` keeps is what the chip held, and what it writes is the firmware, which then
// answers.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <simavr/sim_avr.h>
#include <sys/wait.h>
#include <unistd.h>

#include "passo/emulator/emulated_chip.hpp"
#include "passo/emulator/emulated_uart.hpp"
#include "passo/wire/decoder.hpp"
#include "passo/wire/message.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t flash_size = 32'768;
constexpr std::uint16_t boot_loader_at = 0x7E00;
constexpr std::uint16_t mcusr = 0x54;
constexpr std::uint8_t by_reset_pin = 2;
constexpr std::uint64_t a_millisecond = 16'000;
constexpr std::uint32_t baud = 1'000'000;  // the boot loader's own rate would take eight times as long

using Flash = std::vector<std::uint8_t>;

// An Intel hex file of less than 64 KiB. Elsewhere the flash is as it was.
void load(const std::string& path, Flash& flash) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line) && line.size() >= 11;) {
    const auto byte = [&](std::size_t i) {
      return static_cast<std::uint8_t>(std::stoul(line.substr(1 + 2 * i, 2), nullptr, 16));
    };
    if (byte(3) != 0) continue;
    const std::size_t address = std::size_t{byte(1)} * 256 + byte(2);
    for (std::size_t i = 0; i < byte(0); ++i) flash.at(address + i) = byte(4 + i);
  }
}

// A program that does nothing, and data after it.
Flash old_contents() {
  Flash flash(flash_size, 0xFF);
  for (std::size_t i = 0; i < boot_loader_at; ++i) flash[i] = static_cast<std::uint8_t>(i * 7 + i / 256);
  flash[0] = 0xFF;
  flash[1] = 0xCF;  // rjmp to itself
  load(PASSO_OPTIBOOT, flash);
  return flash;
}

// The board at the far end of a serial line. Whoever opens the line resets the board.
class BoardOnALine {
 public:
  BoardOnALine() : chip_(PASSO_MOTION_UNO), uart_(chip_, baud) {
    const Flash flash = old_contents();
    std::ranges::copy(flash, chip_.avr().flash);
    chip_.avr().codeend = flash_size;
    chip_.avr().reset_pc = boot_loader_at;
    uart_.on_byte = [this](std::uint8_t byte) { said.push_back(byte); };
    int line = -1;
    std::array<char, 64> name{};
    EXPECT_EQ(openpty(&end_, &line, name.data(), nullptr, nullptr), 0);
    close(line);
    device = name.data();
    fcntl(end_, F_SETFL, O_NONBLOCK);
    reset();
  }
  ~BoardOnALine() { close(end_); }
  BoardOnALine(const BoardOnALine&) = delete;
  BoardOnALine& operator=(const BoardOnALine&) = delete;

  // Lets a millisecond pass.
  void go_on() {
    pollfd one{.fd = end_, .events = POLLIN, .revents = 0};
    poll(&one, 1, uart_.under_way() > 0 || !said.empty() ? 0 : 1);
    if ((one.revents & POLLHUP) != 0) is_open_ = false;
    std::array<std::uint8_t, 512> bytes;
    const ssize_t got = read(end_, bytes.data(), bytes.size());
    if (got > 0) {
      if (!std::exchange(is_open_, true)) reset();
      uart_.send(std::span(bytes).first(static_cast<std::size_t>(got)));
    }
    chip_.run_for(a_millisecond);
    if (!said.empty() && is_open_ && write(end_, said.data(), said.size()) > 0) said.clear();
  }
  // The answer of the firmware to a question; false: there is none.
  bool answers() {
    said.clear();
    std::uint8_t frame[largest_frame];
    const std::size_t size = encode(Ask{.motors = max_motors}, std::uint8_t{77}, frame);
    uart_.send(std::span(frame).first(size));
    for (int i = 0; i < 100; ++i) chip_.run_for(a_millisecond);
    Decoder decoder;
    decoder.set_motors(max_motors);
    return std::ranges::any_of(said, [&](std::uint8_t byte) {
      return decoder.feed(byte) == Decoded::frame && decoder.frame().type == MessageType::status;
    });
  }
  void reset() {
    avr_reset(&chip_.avr());
    chip_.avr().data[mcusr] = by_reset_pin;
  }
  Flash flash() const {
    const std::uint8_t* const from = const_cast<EmulatedChip&>(chip_).avr().flash;
    return {from, from + flash_size};
  }

  std::string device;
  std::vector<std::uint8_t> said;

 private:
  EmulatedChip chip_;
  EmulatedUart uart_;
  int end_ = -1;
  bool is_open_ = false;
};

// Starts passo and lets the board go on until it has ended. Returns its exit code.
int flash_with(BoardOnALine& board, const fs::path& folder) {
  const std::string backup = (folder / "old.hex").string();
  const std::string said = (folder / "said").string();
  const pid_t child = fork();
  if (child == 0) {
    if (std::freopen(said.c_str(), "w", stdout) == nullptr || std::freopen(said.c_str(), "a", stderr) == nullptr) {
      _exit(1);
    }
    execl(PASSO_PROGRAM, PASSO_PROGRAM, "board", "flash", "uno", "--device", board.device.c_str(), "--backup",
          backup.c_str(), nullptr);
    _exit(1);
  }
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) board.go_on();
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(BootLoader, is_written_to_by_avrdude_and_the_old_contents_are_kept) {
  const fs::path folder = fs::temp_directory_path() / ("passo-boot-" + std::to_string(getpid()));
  fs::create_directories(folder);
  BoardOnALine board;
  EXPECT_FALSE(board.answers()) << "it is no board of Passo's yet";
  board.reset();

  std::stringstream words;
  EXPECT_EQ(flash_with(board, folder), 0);
  words << std::ifstream(folder / "said").rdbuf();
  SCOPED_TRACE(words.str());
  Flash kept(flash_size, 0xFF);
  load((folder / "old.hex").string(), kept);
  EXPECT_TRUE(kept == old_contents());
  Flash expected = old_contents();
  load(PASSO_MOTION_UNO_HEX, expected);
  const Flash flash = board.flash();
  // A page is written whole, and what its image does not fill is blank.
  std::size_t wrong = 0;
  Flash image(flash_size, 0xFF);
  load(PASSO_MOTION_UNO_HEX, image);
  for (std::size_t i = 0; i < flash_size; ++i) wrong += flash[i] != expected[i] && flash[i] != image[i] ? 1U : 0U;
  EXPECT_EQ(wrong, 0U);
  EXPECT_TRUE(std::equal(flash.begin() + boot_loader_at, flash.end(), old_contents().begin() + boot_loader_at));
  // The boot loader leaves by its watchdog; from now on the firmware runs.
  for (int i = 0; i < 300; ++i) board.go_on();
  EXPECT_TRUE(board.answers());
  EXPECT_FALSE(fs::exists(folder / "old.hex.unfinished"));
  fs::remove_all(folder);
}

}  // namespace
}  // namespace passo
