// passo board flash: checks that the firmware fits the board, saves the old contents, and writes the firmware. avrdude
// does the writing. A Pico takes a copied file instead (board_drive.hpp).
//
// avrdude checks by the chip's signature that the chip is the expected one, and reads back what it has written.
#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

#include "board_drive.hpp"
#include "board_opening.hpp"
#include "commands.hpp"
#include "program_input.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/wait.h>
#include <unistd.h>

#include "passo/base/result.hpp"
#include "passo/emulator/emulated_board.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;

struct Chip {
  const char* board;       // the beginning of the board's name
  const char* part;        // avrdude's option -p
  const char* programmer;  // avrdude's option -c for the boot loader
  unsigned flash;          // bytes of flash without the boot loader
};
constexpr std::array chips = {Chip{"uno", "atmega328p", "arduino", 32'768 - 512},
                              Chip{"mega", "atmega2560", "wiring", 262'144 - 8'192}};

std::optional<unsigned> hex_byte(const std::string& line, std::size_t at) {
  if (at + 2 > line.size()) return {};
  unsigned value = 0;
  for (const char digit : {line[at], line[at + 1]}) {
    const char low = static_cast<char>(digit | 0x20);
    if (digit >= '0' && digit <= '9') {
      value = value * 16 + static_cast<unsigned>(digit - '0');
    } else if (low >= 'a' && low <= 'f') {
      value = value * 16 + static_cast<unsigned>(low - 'a' + 10);
    } else {
      return {};
    }
  }
  return value;
}

struct HexRecord {
  unsigned address = 0;
  unsigned type = 0;
  std::vector<unsigned> data;
};

// Intel, Hexadecimal Object File Format Specification, revision A, 1988: ':' count address type data checksum.
std::optional<HexRecord> read_record(const std::string& line) {
  const auto count = line.empty() || line[0] != ':' ? std::nullopt : hex_byte(line, 1);
  if (!count || line.size() != 11 + 2 * *count) return {};
  std::vector<unsigned> bytes;
  unsigned sum = 0;
  for (std::size_t at = 1; at < line.size(); at += 2) {
    const auto byte = hex_byte(line, at);
    if (!byte) return {};
    bytes.push_back(*byte);
    sum += *byte;
  }
  if (sum % 256 != 0) return {};
  return HexRecord{
      .address = bytes[1] * 256 + bytes[2], .type = bytes[3], .data = {bytes.begin() + 4, bytes.end() - 1}};
}

// The address in the flash at which the image ends, or what is wrong with the image.
Result<unsigned, std::string> size_of_image(const std::string& path) {
  std::ifstream file(path);
  if (!file) return Failure{path + ": cannot be read"};
  unsigned base = 0;
  unsigned end = 0;
  std::string line;
  for (unsigned number = 1; std::getline(file, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    const auto record = read_record(line);
    if (!record) return Failure{fmt::format("{}:{}: not a record of an Intel hex file, or damaged", path, number)};
    const std::vector<unsigned>& data = record->data;
    if (record->type == 1) return end;
    if (record->type == 2 && data.size() == 2) base = (data[0] * 256 + data[1]) * 16;
    if (record->type == 4 && data.size() == 2) base = (data[0] * 256 + data[1]) << 16;
    if (record->type == 0) end = std::max(end, base + record->address + static_cast<unsigned>(data.size()));
  }
  return Failure{path + ": has no end record, so it may be truncated"};
}

// Runs a program and returns its exit code; 127 if there is no such program. There is no shell in between, so a file
// name may have any characters. Ctrl-C ends that program, and not this one.
int start(const std::vector<std::string>& words) {
  std::fflush(nullptr);
  const auto on_interrupt = std::signal(SIGINT, SIG_IGN);
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGINT, on_interrupt);
    std::vector<char*> pointers;
    for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
    pointers.push_back(nullptr);
    execvp(pointers[0], pointers.data());
    _exit(127);
  }
  int status = 0;
  const bool ended = child > 0 && waitpid(child, &status, 0) > 0;
  std::signal(SIGINT, on_interrupt);
  if (!ended) return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// The file with what the board held before. It is the way back, so nothing ever overwrites it. Beside it lies a file
// .unfinished as long as the board may hold half a program: whoever flashes again finds there that this file is whole.
class Backup {
 public:
  explicit Backup(std::string path) : path_(std::move(path)) {}
  const std::string& path() const { return path_; }
  bool is_of_unfinished() const { return fs::exists(path_) && fs::exists(mark()); }
  bool is_of_another() const { return fs::exists(path_) && !fs::exists(mark()); }
  // What avrdude has written is not whole.
  void drop() const {
    std::error_code none;
    fs::remove(path_, none);
  }
  bool begin_writing() const {
    std::ofstream file(mark());
    file << "the board's firmware may be incomplete\n" << std::flush;
    return file.good();
  }
  void end_writing() const {
    std::error_code none;
    fs::remove(mark(), none);
  }

 private:
  std::string mark() const { return path_ + ".unfinished"; }

  std::string path_;
};

// avrdude with one task.
using Words = std::vector<std::string>;

int fail_of_avrdude(int code, const std::string& board_is) {
  if (code == 127) return fail(exit_failed, "avrdude is not installed: apt-get install avrdude");
  return fail(exit_failed, fmt::format("avrdude ended with {}; {}", code, board_is));
}

// Keeps what the board holds, and writes the new. Returns the exit code.
int keep_and_write(const Backup& backup, const Words& read_old, const Words& write_new, bool dry_run) {
  const auto run = [&](const Words& words) {
    fmt::print("+ {}\n", fmt::join(words, " "));
    return dry_run ? 0 : start(words);
  };
  if (backup.is_of_unfinished()) {
    fmt::print("{} holds the firmware from before the failed attempt, and is kept\n", backup.path());
  } else if (const int code = run(read_old); code != 0) {
    backup.drop();
    return fail_of_avrdude(code, "the board is unchanged");
  }
  if (!dry_run && !backup.begin_writing()) {
    return fail(exit_failed, backup.path() + ".unfinished: cannot be written; the board is unchanged");
  }
  if (const int code = run(write_new); code != 0) {
    return fail_of_avrdude(
        code, fmt::format("the board's firmware may be incomplete. Repeat the command; the old firmware is kept in {}",
                          backup.path()));
  }
  backup.end_writing();
  return exit_done;
}

}  // namespace

int board_flash(const BoardFlashArguments& arguments) {
  if (is_pico(arguments.board)) return flash_by_copying(arguments);
  if (arguments.device.empty()) {
    return fail(exit_bad_program,
                "the serial port of the board is missing, e.g. --device /dev/ttyACM0; see passo board list");
  }
  const Chip& chip = *std::find_if(chips.begin(), chips.end(),
                                   [&](const Chip& one) { return arguments.board.starts_with(one.board); });
  const std::string image = arguments.image.empty() ? built_image(arguments.board, ".hex").string() : arguments.image;
  if (arguments.image.empty() && !fs::exists(image)) {
    return fail(exit_failed, message_of_missing(image));
  }
  const auto size = size_of_image(image);
  if (!size) return fail(exit_bad_program, size.error());
  if (*size > chip.flash) {
    return fail(exit_bad_program,
                fmt::format("{}: {} bytes; the {} has room for {}", image, *size, chip.part, chip.flash));
  }
  const Backup backup(arguments.backup.empty() ? fmt::format("passo-backup-{}.hex", arguments.board)
                                               : arguments.backup);
  if (backup.is_of_another()) {
    return fail(exit_bad_program,
                backup.path() + " already exists (the backup of an earlier flash); choose another file with --backup");
  }

  const Words avrdude = {"avrdude",
                         "-p",
                         chip.part,
                         "-c",
                         arguments.programmer.empty() ? chip.programmer : arguments.programmer,
                         "-P",
                         arguments.device,
                         "-b",
                         std::to_string(arguments.baud),
                         "-D"};
  auto with = [&](const std::string& what) {
    Words words = avrdude;
    words.insert(words.end(), {"-U", what});
    return words;
  };
  const auto read_old = with("flash:r:" + backup.path() + ":i");
  const auto write_new = with("flash:w:" + image + ":i");
  const auto write_old = with("flash:w:" + backup.path() + ":i");
  fmt::print("{}: {} of {} bytes\n", image, *size, chip.flash);
  if (const int code = keep_and_write(backup, read_old, write_new, arguments.dry_run); code != exit_done) return code;
  fmt::print("{}To restore the old firmware: {}\n", arguments.dry_run ? "Dry run: nothing was changed. " : "Done. ",
             fmt::join(write_old, " "));
  return exit_done;
}

}  // namespace passo
