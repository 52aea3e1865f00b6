// The follower's image for a PIC16F877A in gpsim: a script with stimuli and switches goes in, a log of the writes to
// the ports comes out.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "passo/emulator/emulated_follower.hpp"

namespace passo {
namespace {

// Where a line is on the chip, and whether the pin is high while the line is.
struct InputPin {
  std::string pin;
  bool straight = true;
};
// The bits of an output on its port, F1 first.
struct OutputPins {
  std::string port;
  std::vector<unsigned> bits;
  bool straight = true;
};
struct PicPins {
  Nanoseconds cycle = 0;  // of an instruction
  std::map<std::string, InputPin> inputs;
  std::map<std::string, OutputPins> outputs;
  std::array<int, 4> rows;  // bits of port B
  std::array<int, 3> columns;
};

PicPins pins_of(PicFollower board) {
  PicPins pins = {.cycle = 200,
                  .inputs = {{"clock.x", {"porta0"}},
                             {"clock.y", {"porta1"}},
                             {"clock.z", {"porta2"}},
                             {"direction.x", {"porta3"}},
                             {"direction.y", {"porta4"}},
                             {"direction.z", {"porta5"}},
                             {"relay", {"porte0"}},
                             {"button", {"portb3", false}}},
                  .outputs = {{"windings.x", {"portd", {4, 5, 6, 7}}},
                              {"windings.y", {"portc", {7, 4, 5, 6}}},
                              {"windings.z", {"portc", {2, 3, 0, 1}}},
                              {"relay", {"portd", {0}}},
                              {"indicator.relay", {"porte", {2}}}},
                  .rows = {4, 5, 6, 7},
                  .columns = {0, 1, 2}};
  if (board == PicFollower::at_20_mhz) {
    pins.outputs.insert({{"indicator.automatic", {"portd", {1}}}, {"indicator.manual", {"portd", {2}}}});
    return pins;
  }
  pins.cycle = 1000;
  pins.inputs["button"] = {"porte1", false};
  pins.outputs.insert({{"led.0", {"portb", {0}}},
                       {"led.1", {"portd", {1}, false}},
                       {"led.2", {"portd", {2}, false}},
                       {"led.3", {"portd", {3}, false}}});
  pins.rows = {2, 3, 4, 6};
  pins.columns = {1, 7, 5};
  return pins;
}

void write_stimuli(std::ostream& out, const PicPins& pins, std::span<const LineChange> lines) {
  int number = 0;
  for (const auto& [line, where] : pins.inputs) {
    std::ostringstream changes;
    bool initial = false;
    const char* separator = "";
    for (const LineChange& change : lines) {
      if (change.line != line) continue;
      if (change.at == 0) {
        initial = change.high;
        continue;
      }
      changes << separator << change.at / pins.cycle << "," << (change.high == where.straight ? 1 : 0);
      separator = ", ";
    }
    out << "stimulus asynchronous_stimulus\n initial_state " << (initial == where.straight ? 1 : 0)
        << "\n start_cycle 0\n { ";
    // gpsim does not like an empty list.
    out << (changes.str().empty() ? "1," + std::to_string(initial == where.straight ? 1 : 0) : changes.str());
    out << " }\n name s" << number << "\nend\n";
    out << "node n" << number << "\nattach n" << number << " s" << number << " " << where.pin << "\n";
    ++number;
  }
}

std::string switch_name(const std::string& line) {
  const KeyPlace place = key_place(line);
  return "key" + std::to_string(place.row) + std::to_string(place.column);
}

// A switch for each key that is used, between its row and its column.
void write_keypad(std::ostream& out, const PicPins& pins, std::span<const LineChange> lines) {
  out << "module library libgpsim_modules\n";
  std::map<std::string, std::string> nodes;  // what hangs on each row and column
  std::set<std::string> keys;
  for (const LineChange& change : lines) {
    if (!change.line.starts_with("key.") || !keys.insert(change.line).second) continue;
    const KeyPlace place = key_place(change.line);
    const std::string name = switch_name(change.line);
    out << "module load switch " << name << "\n";
    nodes["portb" + std::to_string(pins.rows.at(static_cast<std::size_t>(place.row)))] += " " + name + ".A";
    nodes["portb" + std::to_string(pins.columns.at(static_cast<std::size_t>(place.column)))] += " " + name + ".B";
  }
  for (const auto& [pin, ends] : nodes) out << "node n" << pin << "\nattach n" << pin << ends << " " << pin << "\n";
}

void write_script(const std::filesystem::path& script, const PicPins& pins, std::span<const LineChange> lines,
                  Nanoseconds end, Turns turns) {
  std::ofstream out(script);
  // gpsim's watchdog goes by the crystal.
  out << "frequency " << 4'000'000'000 / pins.cycle << "\n";
  write_stimuli(out, pins, lines);
  write_keypad(out, pins, lines);
  out << "log on pins.log\nlog w portb\nlog w portc\nlog w portd\nlog w porte\n"
      << (turns == Turns::watched ? "log r porta\n" : "");
  Nanoseconds stopped = -1;
  for (const LineChange& change : lines) {
    const bool reset = change.line == "reset";
    if ((!reset && !change.line.starts_with("key.")) || change.at >= end) continue;
    // Several at one time: gpsim would never stop where it stands.
    if (change.at != stopped) out << "break c " << change.at / pins.cycle << "\nrun\n";
    stopped = change.at;
    if (reset) {
      out << "reset\n";
      continue;
    }
    out << switch_name(change.line) << ".state = " << (change.high ? "true" : "false") << "\n";
  }
  out << "break c " << end / pins.cycle << "\nrun\nquit\n";
}

unsigned value_on(const OutputPins& pins, unsigned port) {
  unsigned value = 0;
  for (unsigned i = 0; i < pins.bits.size(); ++i) {
    if (((port >> pins.bits[i] & 1) != 0) == pins.straight) value |= 1U << i;
  }
  return value;
}

// gpsim's log; nothing if no port was ever written. A line with the cycle, then what the instruction did, "  Wrote:
// 0x00FD to portc(0x0007) was 0x0000".
std::optional<FollowerRun> read_log(const std::filesystem::path& log, const PicPins& pins) {
  std::ifstream in(log);
  FollowerRun run;
  std::map<std::string, unsigned> values;
  Nanoseconds sampled = 0;
  Nanoseconds at = 0;
  bool is_program = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("0x")) at = static_cast<Nanoseconds>(std::stoull(line, nullptr, 16)) * pins.cycle;
    if (line.find("Read: ") != std::string::npos && line.find("from porta(") != std::string::npos) {
      if (sampled != 0) {
        run.longest_turn = std::max(run.longest_turn, static_cast<std::uint64_t>((at - sampled) / pins.cycle));
      }
      sampled = at;
    }
    // If gpsim does not find the source, it ends no line after its number.
    const std::size_t written = line.find("Wrote: ");
    if (written == std::string::npos) continue;
    is_program = true;
    std::istringstream words(line.substr(written));
    std::string wrote;
    std::string value;
    std::string to;
    std::string where;
    words >> wrote >> value >> to >> where;
    const std::string port = where.substr(0, where.find('('));
    const auto now = static_cast<unsigned>(std::stoul(value, nullptr, 16));
    for (const auto& [output, output_pins] : pins.outputs) {
      if (output_pins.port != port) continue;
      const unsigned shown = value_on(output_pins, now);
      unsigned& before = values.try_emplace(output, 0U).first->second;
      if (shown != before) {
        run.changes.push_back({at, output, output_pins.bits.size() == 4 ? winding_text(shown) : std::to_string(shown)});
      }
      before = shown;
    }
  }
  if (!is_program) return {};
  return run;
}

std::string last_line_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string last;
  for (std::string line; std::getline(in, line);) {
    if (!line.empty()) last = line;
  }
  return last;
}

// Runs gpsim in the folder. False if it cannot be started or fails. A .cod file names its processor, a .hex does not.
bool run_gpsim(const std::filesystem::path& work, const std::string& image) {
  const pid_t child = ::fork();
  if (child == 0) {
    const int nothing = ::open("/dev/null", O_RDONLY);
    if (::chdir(work.c_str()) != 0) ::_exit(126);
    const int said = ::open("said.txt", O_WRONLY | O_CREAT | O_TRUNC, 0644);
    ::dup2(nothing, STDIN_FILENO);
    ::dup2(said, STDOUT_FILENO);
    ::dup2(said, STDERR_FILENO);
    // A gpsim that hangs would hang for good.
    const char* const kind = image.ends_with(".hex") ? "-ppic16f877a" : "-s";
    ::execlp("timeout", "timeout", "600", "gpsim", "-i", kind, image.c_str(), "-c", "script.stc",
             static_cast<char*>(nullptr));
    ::_exit(127);
  }
  int status = -1;
  return child > 0 && ::waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

KeyPlace key_place(std::string_view line) {
  constexpr std::string_view names = "123456789*0#";
  const std::size_t index = line.size() == 5 && line.starts_with("key.") ? names.find(line.back()) : names.npos;
  if (index == names.npos) return {-1, -1};
  return {static_cast<int>(index / 3), static_cast<int>(index % 3)};
}

std::string winding_text(unsigned pattern) {
  std::string text;
  for (unsigned f = 0; f < 4; ++f) text += (pattern >> f & 1) != 0 ? '1' : '0';
  return text;
}

bool gpsim_is_here() {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (::access((folder + "/gpsim").c_str(), X_OK) == 0) return true;
  }
  return false;
}

Result<FollowerRun, std::string> run_pic_follower(PicFollower board, const std::filesystem::path& image,
                                                  std::span<const LineChange> lines, Nanoseconds end,
                                                  const std::filesystem::path& work, Turns turns) {
  if (!gpsim_is_here())
    return Failure<std::string>{"gpsim, which emulates the PIC, is not installed: run scripts/install.sh"};
  if (!std::filesystem::exists(image)) return Failure<std::string>{"no such image: " + image.string()};
  const PicPins pins = pins_of(board);
  std::filesystem::create_directories(work);
  std::filesystem::remove(work / "pins.log");
  write_script(work / "script.stc", pins, lines, end, turns);
  if (!run_gpsim(work, std::filesystem::absolute(image)) || !std::filesystem::exists(work / "pins.log")) {
    return Failure<std::string>{"gpsim failed; its last output: " + last_line_of(work / "said.txt")};
  }
  std::optional<FollowerRun> run = read_log(work / "pins.log", pins);
  std::filesystem::remove(work / "pins.log");  // some 10 MB
  if (!run) return Failure{image.string() + " is not firmware for a PIC16F877A: it never writes to a port"};
  return *std::move(run);
}

}  // namespace passo
