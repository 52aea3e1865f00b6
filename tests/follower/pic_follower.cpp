#include "follower/pic_follower.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

namespace passo {
namespace {

constexpr Nanoseconds cycle = 200;  // an instruction at 20 MHz

// Where a line of a vector is on the chip, and whether the pin is high where the line is.
struct InputPin {
  std::string pin;
  bool straight = true;
};
const std::map<std::string, InputPin> input_pins = {
    {"clock.x", {"porta0"}},     {"clock.y", {"porta1"}},     {"clock.z", {"porta2"}}, {"direction.x", {"porta3"}},
    {"direction.y", {"porta4"}}, {"direction.z", {"porta5"}}, {"relay", {"porte0"}},   {"button", {"portb3", false}}};

// The bits of an output on its port, F1 first.
struct OutputPins {
  std::string port;
  std::vector<unsigned> bits;
};
const std::map<std::string, OutputPins> output_pins = {
    {"windings.x", {"portd", {4, 5, 6, 7}}}, {"windings.y", {"portc", {7, 4, 5, 6}}},
    {"windings.z", {"portc", {2, 3, 0, 1}}}, {"relay", {"portd", {0}}},
    {"indicator.relay", {"porte", {2}}},     {"indicator.automatic", {"portd", {1}}},
    {"indicator.manual", {"portd", {2}}}};

void write_stimuli(std::ostream& out, const FollowerVector& vector) {
  int number = 0;
  for (const auto& [line, where] : input_pins) {
    std::ostringstream changes;
    bool initial = false;
    const char* separator = "";
    for (const LineChange& change : vector.lines) {
      if (change.line != line) continue;
      if (change.at == 0) {
        initial = change.high;
        continue;
      }
      changes << separator << change.at / cycle << "," << (change.high == where.straight ? 1 : 0);
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
void write_keypad(std::ostream& out, const FollowerVector& vector) {
  out << "module library libgpsim_modules\n";
  std::map<std::string, std::string> nodes;  // what hangs on each row and column
  std::set<std::string> keys;
  for (const LineChange& change : vector.lines) {
    if (!change.line.starts_with("key.") || !keys.insert(change.line).second) continue;
    const KeyPlace place = key_place(change.line);
    const std::string name = switch_name(change.line);
    out << "module load switch " << name << "\n";
    nodes["portb" + std::to_string(4 + place.row)] += " " + name + ".A";
    nodes["portb" + std::to_string(place.column)] += " " + name + ".B";
  }
  for (const auto& [pin, ends] : nodes) out << "node n" << pin << "\nattach n" << pin << ends << " " << pin << "\n";
}

void write_script(const std::filesystem::path& script, const FollowerVector& vector, Turns turns) {
  std::ofstream out(script);
  write_stimuli(out, vector);
  write_keypad(out, vector);
  out << "log on pins.log\nlog w portc\nlog w portd\nlog w porte\n" << (turns == Turns::watched ? "log r porta\n" : "");
  Nanoseconds stopped = -1;
  for (const LineChange& change : vector.lines) {
    const bool reset = change.line == "reset";
    if ((!reset && !change.line.starts_with("key.")) || change.at >= vector.end) continue;
    // Several at one time: gpsim would never stop where it stands.
    if (change.at != stopped) out << "break c " << change.at / cycle << "\nrun\n";
    stopped = change.at;
    if (reset) {
      out << "reset\n";
      continue;
    }
    out << switch_name(change.line) << ".state = " << (change.high ? "true" : "false") << "\n";
  }
  out << "break c " << vector.end / cycle << "\nrun\nquit\n";
}

unsigned value_on(const std::vector<unsigned>& bits, unsigned port) {
  unsigned value = 0;
  for (unsigned i = 0; i < bits.size(); ++i) value |= (port >> bits[i] & 1) << i;
  return value;
}

// gpsim's log: a line with the cycle, then what the instruction did, "  Wrote: 0x00FD to portc(0x0007) was 0x0000".
ChipRun read_log(const std::filesystem::path& log) {
  std::ifstream in(log);
  ChipRun run;
  std::map<std::string, unsigned> values;
  Nanoseconds sampled = 0;
  Nanoseconds at = 0;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("0x")) at = static_cast<Nanoseconds>(std::stoull(line, nullptr, 16)) * cycle;
    if (line.find("Read: ") != std::string::npos && line.find("from porta(") != std::string::npos) {
      if (sampled != 0) {
        run.longest_turn = std::max(run.longest_turn, static_cast<std::uint64_t>((at - sampled) / cycle));
      }
      sampled = at;
    }
    // Where gpsim does not find the source, it ends no line after its number.
    const std::size_t written = line.find("Wrote: ");
    if (written == std::string::npos) continue;
    std::istringstream words(line.substr(written));
    std::string wrote;
    std::string value;
    std::string to;
    std::string where;
    words >> wrote >> value >> to >> where;
    const std::string port = where.substr(0, where.find('('));
    const auto now = static_cast<unsigned>(std::stoul(value, nullptr, 16));
    for (const auto& [output, pins] : output_pins) {
      if (pins.port != port) continue;
      const unsigned shown = value_on(pins.bits, now);
      unsigned& before = values.try_emplace(output, 0U).first->second;
      if (shown != before) {
        run.changes.push_back({at, output, pins.bits.size() == 4 ? winding_text(shown) : std::to_string(shown)});
      }
      before = shown;
    }
  }
  return run;
}

}  // namespace

bool gpsim_is_here() {
  return std::system("command -v gpsim >/dev/null 2>&1") == 0;
}

ChipRun run_on_pic(const std::string& images, const FollowerVector& vector, const std::filesystem::path& work,
                   Turns turns) {
  const std::string image = images + "_" + vector.drive + ".cod";
  if (!std::filesystem::exists(image)) throw std::runtime_error("no such image: " + image);
  std::filesystem::create_directories(work);
  std::filesystem::remove(work / "pins.log");
  write_script(work / "script.stc", vector, turns);
  const std::string command =
      "cd '" + work.string() + "' && timeout 60 gpsim -i -s '" + image + "' -c script.stc </dev/null >said.txt 2>&1";
  if (std::system(command.c_str()) != 0 || !std::filesystem::exists(work / "pins.log")) {
    throw std::runtime_error("gpsim failed; what it said is in " + (work / "said.txt").string());
  }
  ChipRun run = read_log(work / "pins.log");
  std::filesystem::remove(work / "pins.log");  // some 10 MB
  return run;
}

}  // namespace passo
