// gpsim is fed with a file for each input line and piece, and with commands for the keys; a log of the writes to the
// ports comes out.
#include "passo/emulator/running_pic.hpp"

#include <algorithm>
#include <deque>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include "gpsim_process.hpp"
#include "pic_log.hpp"
#include "pic_pins.hpp"

#include "passo/emulator/hex_file.hpp"

namespace passo {
namespace {

// gpsim may stop a cycle beside the one that it was told, within an instruction of two cycles. An input that changes
// there would be set twice, or not at all.
constexpr Nanoseconds quiet_cycles = 2;

std::string switch_name(const std::string& line) {
  const KeyPlace place = key_place(line);
  return "key" + std::to_string(place.row) + std::to_string(place.column);
}

// A switch for each key that is used, between its row and its column.
void write_keypad(std::ostream& out, const PicPins& pins, std::span<const std::string> keys) {
  std::map<std::string, std::string> nodes;  // what hangs on each row and column
  for (const std::string& key : keys) {
    const KeyPlace place = key_place(key);
    const std::string name = switch_name(key);
    out << "module load switch " << name << "\n";
    nodes["portb" + std::to_string(pins.rows.at(static_cast<std::size_t>(place.row)))] += " " + name + ".A";
    nodes["portb" + std::to_string(pins.columns.at(static_cast<std::size_t>(place.column)))] += " " + name + ".B";
  }
  for (const auto& [pin, ends] : nodes) out << "node n" << pin << "\nattach n" << pin << ends << " " << pin << "\n";
}

// A line of the board at its pin.
struct FedLine {
  std::string line;
  bool straight = true;
  bool high = false;  // the line, now
  bool is_fed = false;
};

}  // namespace

struct RunningPic::State {
  PicPins pins;
  std::filesystem::path work;
  Turns turns = Turns::unwatched;
  std::unique_ptr<GpsimProcess> gpsim;
  std::optional<PicLog> log;
  std::vector<FedLine> fed;
  std::deque<LineChange> ahead;  // changes after now
  Nanoseconds now = 0;
  std::int64_t cycle = 0;  // at which gpsim stands

  std::string set_up(std::span<const std::string> keys);
  void feed(std::size_t number, std::size_t count, std::ostream& commands);
  void go_to(Nanoseconds time, std::ostream& commands);
  Result<FollowerRun, std::string> run(Nanoseconds end);
};

std::string RunningPic::State::set_up(std::span<const std::string> keys) {
  std::ostringstream out;
  // gpsim's watchdog goes by the crystal.
  out << "frequency " << 4'000'000'000 / pins.cycle << "\nmodule library libgpsim_modules\n";
  for (const auto& [line, where] : pins.inputs) {
    const std::size_t number = fed.size();
    out << "module load FileStimulus s" << number << "\nnode n" << number << "\nattach n" << number << " s" << number
        << ".pin " << where.pin << "\n";
    fed.push_back({.line = line, .straight = where.straight});
  }
  write_keypad(out, pins, keys);
  // Each of these takes a break point for good, of 1024.
  out << "log w portb\nlog w portc\nlog w portd\nlog w porte\n" << (turns == Turns::watched ? "log r porta\n" : "");
  return out.str();
}

// Writes the file of a line: its level now, and its changes among the first `count` ones ahead. A pulse that is shorter
// than a cycle is none.
void RunningPic::State::feed(std::size_t number, std::size_t count, std::ostream& commands) {
  FedLine& one = fed[number];
  std::vector<std::pair<std::int64_t, bool>> levels{{now / pins.cycle, one.high}};
  bool changes = false;
  for (std::size_t i = 0; i < count; ++i) {
    if (ahead[i].line != one.line) continue;
    changes = true;
    const std::int64_t at = ahead[i].at / pins.cycle;
    one.high = ahead[i].high;
    if (levels.back().first == at) {
      levels.back().second = one.high;
    } else {
      levels.emplace_back(at, one.high);
    }
  }
  const bool is_first = !std::exchange(one.is_fed, true);
  if (!changes && !is_first) return;
  const std::string name = "s" + std::to_string(number);
  std::ofstream file(work / name);
  // gpsim takes no notice of a first level of 5 V, because that is what a stimulus has before.
  if (is_first && levels.front().second == one.straight) {
    file << "0 0\n";
    levels.front().first = std::max<std::int64_t>(levels.front().first, 1);
  }
  for (const auto& [at, high] : levels) file << at << (high == one.straight ? " 5\n" : " 0\n");
  commands << name << ".file = \"" << name << "\"\n";
}

// gpsim would never stop where it stands.
void RunningPic::State::go_to(Nanoseconds time, std::ostream& commands) {
  const std::int64_t wanted = time / pins.cycle;
  if (wanted > cycle) commands << "break c " << wanted << "\nrun\n";
  cycle = std::max(cycle, wanted);
}

Result<FollowerRun, std::string> RunningPic::State::run(Nanoseconds end) {
  const auto later = std::ranges::upper_bound(ahead, end, {}, &LineChange::at);
  const auto count = static_cast<std::size_t>(later - ahead.begin());
  std::ostringstream commands;
  for (std::size_t number = 0; number < fed.size(); ++number) feed(number, count, commands);
  commands << "log on pins.log\n";
  for (std::size_t i = 0; i < count; ++i) {
    const LineChange& change = ahead[i];
    const bool reset = change.line == "reset";
    if (!reset && !change.line.starts_with("key.")) continue;
    go_to(change.at, commands);
    if (reset) {
      commands << "reset\n";
      continue;
    }
    commands << switch_name(change.line) << ".state = " << (change.high ? "true" : "false") << "\n";
  }
  go_to(end, commands);
  commands << "log off\n";
  if (!gpsim->execute(commands.str())) return Failure{"gpsim failed; its last output: " + gpsim->last_line()};
  ahead.erase(ahead.begin(), later);
  now = end;
  FollowerRun run;
  log->read(work / "pins.log", run);
  std::filesystem::remove(work / "pins.log");  // 10 MB of a busy minute
  return run;
}

RunningPic::RunningPic(std::unique_ptr<State> state) : state_(std::move(state)) {}
RunningPic::~RunningPic() = default;

Result<std::unique_ptr<RunningPic>, std::string> RunningPic::start(PicFollower board,
                                                                   const std::filesystem::path& image,
                                                                   const std::filesystem::path& work,
                                                                   std::span<const std::string> keys, Turns turns) {
  if (!gpsim_is_here())
    return Failure<std::string>{"gpsim, which emulates the PIC, is not installed: run scripts/install.sh"};
  if (!std::filesystem::exists(image)) return Failure<std::string>{"no such image: " + image.string()};
  if (image.extension() == ".hex") {
    if (const std::string fault = find_hex_fault(image); !fault.empty()) {
      return Failure<std::string>{image.string() + " is not an Intel HEX file: " + fault};
    }
  }
  std::filesystem::create_directories(work);
  auto state = std::make_unique<State>();
  state->pins = pins_of(board);
  state->work = work;
  state->turns = turns;
  state->log.emplace(state->pins);
  state->gpsim = std::make_unique<GpsimProcess>(work, std::filesystem::absolute(image));
  if (!state->gpsim->execute(state->set_up(keys))) {
    return Failure{"gpsim failed; its last output: " + state->gpsim->last_line()};
  }
  return std::unique_ptr<RunningPic>(new RunningPic(std::move(state)));
}

void RunningPic::add(std::span<const LineChange> lines) {
  state_->ahead.insert(state_->ahead.end(), lines.begin(), lines.end());
}

Result<FollowerRun, std::string> RunningPic::run_before(Nanoseconds end) {
  const Nanoseconds quiet = quiet_cycles * state_->pins.cycle;
  Nanoseconds cut = end - quiet;
  for (auto change = state_->ahead.rbegin(); change != state_->ahead.rend() && change->at >= cut - quiet; ++change) {
    if (change->at <= cut + quiet) cut = change->at - quiet - 1;
  }
  if (cut <= state_->now) return FollowerRun();
  return state_->run(cut);
}

Result<FollowerRun, std::string> RunningPic::run_to(Nanoseconds end) {
  return state_->run(end);
}

Nanoseconds RunningPic::now() const {
  return state_->now;
}

bool RunningPic::has_written() const {
  return state_->log->has_writes();
}

}  // namespace passo
