#include "follower/vector.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <sstream>
#include <stdexcept>

namespace passo {
namespace {

namespace fs = std::filesystem;

std::string in_microseconds(Nanoseconds time) {
  std::ostringstream text;
  text << static_cast<double>(time) / 1000 << " us";
  return text.str();
}

// Two windings on, and the pair goes round.
const char* two_on(int position) {
  constexpr std::array<const char*, 4> round = {"1100", "0110", "0011", "1001"};
  return round[static_cast<std::size_t>(position & 3)];
}

}  // namespace

bool FollowerVector::needs_keypad() const {
  return std::ranges::any_of(
      lines, [](const LineChange& change) { return change.line.starts_with("key.") || change.line == "button"; });
}

FollowerVector read_follower_vector(const fs::path& file) {
  auto read = read_board_case(file.stem().string(), text_of_file(file));
  if (!read) throw std::runtime_error(read.error());
  return {.name = read->name, .drive = read->drive, .lines = read->lines, .expected = read->due, .end = read->end};
}

std::vector<FollowerVector> follower_vectors(const fs::path& directory) {
  std::vector<FollowerVector> vectors;
  for (const auto& entry : fs::directory_iterator(directory)) {
    if (entry.path().extension() == ".txt") vectors.push_back(read_follower_vector(entry.path()));
  }
  std::ranges::sort(vectors, {}, &FollowerVector::name);
  return vectors;
}

FollowerVector random_steps(std::uint64_t seed, int steps_an_axis, Nanoseconds shortest, Edges edges,
                            std::string_view axes) {
  std::mt19937_64 turns(seed);
  FollowerVector vector{.name = "random"};
  for (const char axis : axes) {
    const std::string name(1, axis);
    std::mt19937_64 times(edges == Edges::together ? seed : turns());
    const auto span = [&] {
      const auto longest = static_cast<std::uint64_t>(7 * shortest);
      return shortest + (times() % 4 == 0 ? static_cast<Nanoseconds>(times() % longest) : Nanoseconds{0});
    };
    Nanoseconds now = 1'000'000 + span();
    int position = 0;
    bool down = false;
    for (int step = 0; step < steps_an_axis; ++step) {
      vector.lines.push_back({now, "clock." + name, true});
      position += down ? -1 : 1;
      vector.expected.push_back({{now, "windings." + name, two_on(position)}, 60'000});
      now += span();
      vector.lines.push_back({now, "clock." + name, false});
      if (turns() % 5 == 0) {
        down = !down;
        vector.lines.push_back({now, "direction." + name, down});
      }
      now += span();
    }
    vector.end = std::max(vector.end, now + 100'000);
  }
  std::ranges::stable_sort(vector.lines, {}, &LineChange::at);
  return vector;
}

FollowerVector square_wave(std::string_view axes, int pulses, Nanoseconds period) {
  FollowerVector vector{.name = "square wave"};
  vector.end = 1'000'000 + (pulses + 4) * period;
  for (int pulse = 0; pulse < pulses; ++pulse) {
    const Nanoseconds now = 1'000'000 + pulse * period;
    for (const char axis : axes) vector.lines.push_back({now, std::string("clock.") + axis, true});
    for (const char axis : axes) vector.lines.push_back({now + period / 2, std::string("clock.") + axis, false});
    for (const char axis : axes) {
      vector.expected.push_back({{now, std::string("windings.") + axis, two_on(pulse + 1)}, 2 * period});
    }
  }
  return vector;
}

FollowerVector manual_mode_at_full_rate(Nanoseconds level) {
  FollowerVector vector{.name = "manual mode at full rate"};
  vector.end = 60'000'000;
  Nanoseconds shift = 0;
  for (const char* axis : {"x", "y", "z"}) {
    bool high = true;
    for (Nanoseconds now = 1'000'000 + shift; now < vector.end; now += level) {
      vector.lines.push_back({now, std::string("clock.") + axis, high});
      high = !high;
    }
    shift += 2 * level / 3;
  }
  vector.lines.push_back({20'000'000, "key.#", true});
  vector.expected.push_back({{40'000'000, "indicator.manual", "1"}, 9'100'000});
  std::ranges::stable_sort(vector.lines, {}, &LineChange::at);
  return vector;
}

void add_fidgeting(FollowerVector& vector, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  constexpr std::array<const char*, 11> keys = {"1", "2", "3", "4", "5", "6", "7", "8", "9", "*", "0"};
  const auto press = [&](const std::string& line, Nanoseconds from) {
    vector.lines.push_back({from, line, true});
    vector.lines.push_back({from + 5'000'000 + static_cast<Nanoseconds>(random() % 50'000'000), line, false});
  };
  for (Nanoseconds now = 2'000'000; now < vector.end; now += 90'000'000) {
    const std::size_t first = random() % keys.size();
    press(std::string("key.") + keys[first], now);
    if (random() % 4 == 0) press(std::string("key.") + keys[(first + 1) % keys.size()], now);
    if (random() % 2 == 0) press("button", now);
  }
  std::ranges::stable_sort(vector.lines, {}, &LineChange::at);
  vector.end = std::max(vector.end, vector.lines.back().at + 1'000'000);
}

FollowerVector after_automatic_key(const FollowerVector& vector, int factor) {
  constexpr Nanoseconds begin = 100'000'000;
  FollowerVector later = vector;
  for (LineChange& change : later.lines) change.at = begin + change.at * factor;
  for (ExpectedChange& expected : later.expected) {
    expected.change.at = begin + expected.change.at * factor;
    expected.within *= factor;
  }
  later.end = begin + vector.end * factor;
  later.lines.insert(later.lines.begin(), {{10'000'000, "key.*", true}, {60'000'000, "key.*", false}});
  return later;
}

std::vector<std::string> winding_outputs() {
  return {"windings.x", "windings.y", "windings.z"};
}

std::vector<std::string> moved_outputs() {
  return {"windings.x", "windings.y", "windings.z", "relay"};
}

std::vector<std::string> follower_outputs() {
  std::vector<std::string> all = moved_outputs();
  for (const char* indicator : {"relay", "automatic", "manual"}) all.push_back(std::string("indicator.") + indicator);
  return all;
}

std::vector<std::string> first_board_outputs() {
  std::vector<std::string> all = moved_outputs();
  for (const char* shown : {"indicator.relay", "led.0", "led.1", "led.2", "led.3"}) all.emplace_back(shown);
  return all;
}

std::string difference(const FollowerVector& vector, const std::vector<OutputChange>& seen,
                       const std::vector<std::string>& has) {
  // Each output for itself: what changes at one time on two of them has no order.
  std::map<std::string, std::vector<ExpectedChange>> expected;
  std::map<std::string, std::vector<OutputChange>> got;
  for (const ExpectedChange& change : vector.expected) expected[change.change.output].push_back(change);
  for (const OutputChange& change : seen) got[change.output].push_back(change);
  for (const std::string& output : has) {
    const auto& wanted = expected[output];
    const auto& given = got[output];
    for (std::size_t i = 0; i < std::max(wanted.size(), given.size()); ++i) {
      const std::string place = vector.name + ": change " + std::to_string(i + 1) + " of " + output + ": ";
      const std::string want = i < wanted.size()
                                   ? wanted[i].change.value + " from " + in_microseconds(wanted[i].change.at) +
                                         " within " + in_microseconds(wanted[i].within)
                                   : "none";
      const std::string have = i < given.size() ? given[i].value + " at " + in_microseconds(given[i].at) : "none";
      if (i >= wanted.size() || i >= given.size() || given[i].value != wanted[i].change.value ||
          given[i].at < wanted[i].change.at || given[i].at > wanted[i].change.at + wanted[i].within) {
        return place + "expected " + want + ", got " + have;
      }
    }
  }
  return {};
}

std::string text_of_file(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace passo
