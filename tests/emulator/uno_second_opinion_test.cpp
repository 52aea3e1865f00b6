// The Uno's real image in another emulator, avr8js: its edges are those of the host's model, as they are in simavr.
// Whoever errs in both emulators must err in both in the same way.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "emulator/streamed_run.hpp"
#include "kit/seed.hpp"
#include <gtest/gtest.h>

#include "passo/wire/announcement.hpp"

namespace passo {
namespace {

constexpr std::uint8_t motors = 3;
// An instruction of up to four cycles is finished before an interrupt begins.
constexpr std::int64_t most_error = 3;
// What the board takes without an answer being heard.
constexpr int segments_at_once = 28;

std::string hex(const std::vector<std::uint8_t>& bytes) {
  std::string text;
  char digits[3];
  for (const std::uint8_t byte : bytes) {
    std::snprintf(digits, sizeof(digits), "%02x", unsigned{byte});
    text += digits;
  }
  return text;
}

// A hello, a replace and the segments, as the link sends them.
std::vector<std::uint8_t> bytes_of(const std::vector<BoardSegment>& segments, std::uint8_t& sequence) {
  std::vector<std::uint8_t> bytes;
  std::uint8_t frame[largest_frame];
  const auto put = [&](std::uint8_t size) { bytes.insert(bytes.end(), frame, frame + size); };
  put(encode(Hello{.motors = motors}, sequence, frame));
  Announcement announcement(static_cast<std::uint16_t>(sequence + 1), sequence, motors);
  for (const BoardSegment& segment : segments) announcement.add(frame, encode(segment, motors, 0, frame));
  put(encode(announcement.replace(), ++sequence, frame));
  for (const BoardSegment& segment : segments) put(encode(segment, motors, ++sequence, frame));
  return bytes;
}

struct Batch {
  std::uint64_t start = 0;  // cycle
  std::vector<BoardSegment> segments;
};

std::uint64_t cycles_of(const std::vector<BoardSegment>& segments) {
  std::uint64_t cycles = 0;
  for (const BoardSegment& one : segments) {
    const auto last = static_cast<std::int64_t>(one.interval) + std::int64_t{one.change} * (one.events - 1);
    cycles += (static_cast<std::uint64_t>(one.interval) + static_cast<std::uint64_t>(last)) / 2 * one.events >> 16U;
  }
  return cycles;
}

std::vector<SeenSteps> steps_of(std::istream& lines, std::uint64_t from, std::uint64_t to) {
  std::vector<SeenSteps> seen(motors);
  std::uint64_t cycle = 0;
  std::size_t motor = 0;
  int down = 0;
  while (lines >> cycle >> motor >> down) {
    if (cycle >= from && cycle < to) seen.at(motor).push_back({static_cast<std::int64_t>(cycle), down != 0});
  }
  return seen;
}

void expect_edges_of_model(const Batch& batch, const std::vector<SeenSteps>& seen) {
  std::uint64_t events = 0;
  const std::vector<SeenSteps> expected = edges_of_model(batch.segments, motors, events);
  std::optional<std::int64_t> earliest;
  std::optional<std::int64_t> latest;
  std::size_t edges = 0;
  for (std::size_t m = 0; m < motors; ++m) {
    ASSERT_EQ(seen[m].size(), expected[m].size()) << "motor " << m;
    edges += seen[m].size();
    for (std::size_t i = 0; i < seen[m].size(); ++i) {
      ASSERT_EQ(seen[m][i].down, expected[m][i].down) << "motor " << m << ", edge " << i;
      const std::int64_t late = seen[m][i].time - expected[m][i].time;
      earliest = std::min(earliest.value_or(late), late);
      latest = std::max(latest.value_or(late), late);
    }
  }
  ASSERT_TRUE(earliest);
  EXPECT_LE(*latest - *earliest, most_error);
  std::printf("%zu edges of %llu events, error %lld cycles\n", edges, static_cast<unsigned long long>(events),
              static_cast<long long>(*latest - *earliest));
}

TEST(UnoInAvr8js, steps_as_the_host_says) {
  if (!std::filesystem::exists(PASSO_NODE_PACKAGES "/avr8js")) GTEST_SKIP() << "avr8js is missing: scripts/install.sh";
  std::mt19937_64 random(test::seed());
  std::vector<Batch> batches;
  std::uint64_t cycle = 320'000;
  std::uint8_t sequence = 0;
  std::ostringstream said;
  for (const std::uint32_t interval : {120U, 300U, 1'000U, 5'000U}) {
    const StreamKind kind{.shortest_interval = std::max(107U, interval * 7 / 8),
                          .longest_interval = interval,
                          .shortest_segment = 120,
                          .longest_segment = interval < 1'000 ? std::uint8_t{255} : std::uint8_t{130},
                          .segments = segments_at_once,
                          .ramp = interval < 300 ? 10 : 0};
    Batch& batch = batches.emplace_back(Batch{cycle, random_stream(random, motors, kind)});
    const std::vector<std::uint8_t> bytes = bytes_of(batch.segments, sequence);
    said << cycle << ' ' << hex(bytes) << '\n';
    cycle += 2 * 320 * bytes.size() + cycles_of(batch.segments) + 320'000;
  }
  said << cycle << '\n';
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "passo_uno_second_opinion";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "said") << said.str();
  const std::string command = "node '" PASSO_UNO_EDGES "' '" PASSO_NODE_PACKAGES "' '" PASSO_MOTION_UNO_HEX "' <'" +
                              (folder / "said").string() + "' >'" + (folder / "edges").string() + "'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  for (std::size_t i = 0; i < batches.size(); ++i) {
    SCOPED_TRACE("batch " + std::to_string(i));
    std::ifstream edges(folder / "edges");
    const std::uint64_t end = i + 1 < batches.size() ? batches[i + 1].start : cycle;
    expect_edges_of_model(batches[i], steps_of(edges, batches[i].start, end));
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace passo
