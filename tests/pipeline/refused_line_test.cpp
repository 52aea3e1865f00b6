// A line that is refused changes nothing: whatever comes after it, moves as if the line had not come.
#include <random>

#include "grbl_kit.hpp"
#include "kit/in_full.hpp"
#include "kit/path_text.hpp"
#include "kit/seed.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace passo::test {
namespace {

// Lines as a sender may send them, many of them wrong.
class RandomLines {
 public:
  RandomLines(std::uint64_t seed, std::vector<std::string> codes) : random_(seed), codes_(std::move(codes)) {}

  std::string next() {
    std::vector<std::string> words;
    for (std::size_t codes = below(4); codes > 0; --codes) words.push_back(codes_[below(codes_.size())]);
    for (const char axis : {'X', 'Y', 'Z'}) {
      if (below(9) < 4) words.push_back(axis + number(-50, 50));
    }
    for (const char letter : std::string_view("IJKRFSTPLNQD")) {
      if (below(letter == 'F' ? 3 : 9) == 0) words.push_back(letter + number(letter < 'L' ? -20 : 0, 200));
    }
    if (below(3) == 0) std::shuffle(words.begin(), words.end(), random_);
    std::string line = fmt::format("{}", fmt::join(words, below(2) == 0 ? " " : ""));
    if (below(15) == 0) line += std::array{"(c)", "(a;b)", "%", "Z--2", "X1.2.3", "#5221=3"}[below(6)];
    return line;
  }

 private:
  std::size_t below(std::size_t end) { return std::uniform_int_distribution<std::size_t>(0, end - 1)(random_); }
  std::string number(int low, int high) {
    const double value = std::uniform_real_distribution<double>(low, high)(random_);
    switch (below(12)) {
      case 0: return "";
      case 1: return "-.5";
      case 2:
      case 3: return fmt::format("{:.3f}", value);
      default: return fmt::format("{:.0f}", value);
    }
  }

  std::mt19937_64 random_;
  std::vector<std::string> codes_;
};

MachineDescription wide_router() {
  MachineDescription machine = example_machine("router");
  for (AxisDescription& axis : machine.axes) {
    axis.travel_low = -2000;
    axis.travel_high = 2000;
  }
  return machine;
}

// All that a program has set, and where it is.
std::string state_of(const StreamedProgram& program) {
  const ActiveModes modes = program.modes();
  const GrblUnits units{.axes = {Axis::x, Axis::y, Axis::z}};
  std::string text = modes_text(modes, units) + places_text(modes.position, units) +
                     places_text(modes.frame.machine_from_work(Point()), units) + "\n";
  for (const auto& [number, value] : program.parameters()) {
    if (value != 0) text += fmt::format("#{}={} ", number, value);
  }
  return text + fmt::format("\n{} queued", program.queued());
}

// What the machine would do, up to where it waits for the next line.
std::string played(StreamedProgram& program) {
  std::string text;
  for (PathItem item; program.next(item);) {
    const auto* const action = std::get_if<Action>(&item);
    if (action != nullptr && action->kind == Action::Kind::await_line) break;
    const std::string line = to_text(item);
    text += line.substr(line.find(':')) + "\n";  // without the number of the line
  }
  return text;
}

void expect_refused_lines_change_nothing(Dialect dialect, std::vector<std::string> codes) {
  const MachineDescription machine = wide_router();
  InterpreterOptions options;
  options.dialect = dialect;
  StreamedProgram all(machine, options, Point());
  StreamedProgram good(machine, options, Point());
  RandomLines lines(seed(), std::move(codes));
  int refused = 0;
  int taken = 0;
  for (int i = 0; i < fewer(4000); ++i) {
    const std::string line = lines.next();
    const std::string before = state_of(all);
    const bool is_refused = all.add_line(line, Seconds(0)).has_value();
    if (is_refused) {
      ++refused;
      ASSERT_EQ(state_of(all), before) << line;
      continue;
    }
    ++taken;
    ASSERT_FALSE(good.add_line(line, Seconds(0))) << line;
    const std::string done = played(all);
    ASSERT_EQ(done, played(good)) << line;
    ASSERT_EQ(state_of(all), state_of(good)) << line;
  }
  EXPECT_GT(refused, fewer(1000));
  EXPECT_GT(taken, fewer(400));
}

TEST(RefusedLine, of_a_sender_leaves_everything_as_it_was) {
  expect_refused_lines_change_nothing(
      Dialect::grbl,
      {"G0",    "G1",  "G2",    "G3",  "G4",    "G10", "G10 L2", "G10 L20", "G17",   "G18",   "G19", "G20",
       "G21",   "G28", "G28.1", "G30", "G53",   "G54", "G55",    "G59",     "G38.2", "G43.1", "G49", "G80",
       "G90",   "G91", "G91.1", "G92", "G92.1", "G93", "G94",    "G61",     "G5",    "M0",    "M2",  "M3",
       "M3 S9", "M4",  "M5",    "M6",  "M8",    "M9",  "M30",    "M98",     "F99"});
}

// A line of a stream in LinuxCNC's dialect: without cycles, splines, cutter compensation and lathe codes.
TEST(RefusedLine, in_linuxcnc_s_dialect_leaves_everything_as_it_was) {
  expect_refused_lines_change_nothing(
      Dialect::linuxcnc, {"G0",  "G1",  "G2",    "G3",  "G4",  "G10 L2", "G10 L20", "G17", "G18",    "G19",  "G20",
                          "G21", "G53", "G54",   "G55", "G59", "G59.3",  "G43.1",   "G49", "G80",    "G90",  "G91",
                          "G92", "G93", "G92.1", "G94", "G61", "G64 P1", "G52",     "M2",  "M3 S99", "M4",   "M5",
                          "M7",  "M8",  "M9",    "M30", "M19", "M48",    "M49",     "M53", "F99",    "#3=7", "#<a>=2"});
}

// What was sent to a running program is beyond the travel, and ends it as well.
TEST(RefusedLine, that_would_have_ended_the_program_does_not_end_it) {
  StreamedProgram program(example_machine("router"), in_grbl(example_machine("router")), Point());
  ASSERT_TRUE(program.add_line("G1 X9999 F100 M2", Seconds(0)));
  EXPECT_FALSE(program.take_ended());
  ASSERT_FALSE(program.add_line("G1 X5 F100", Seconds(0)));
  EXPECT_EQ(program.queued(), 1U) << "the next line moves";
}

// grbl reads G20 before F, and only if the whole line is good.
TEST(RefusedLine, does_not_switch_to_inches) {
  GrblRun run;
  run.send("I12 G20 X-.5 Z1\n$G\nG20 F10\n$G\n");
  EXPECT_EQ(run.reply(), "error:36");
  EXPECT_EQ(run.reply(), "[GC:G0 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0]");
  EXPECT_EQ(run.reply(), "ok");
  EXPECT_EQ(run.reply(), "ok");
  EXPECT_EQ(run.reply(), "[GC:G0 G54 G17 G20 G90 G94 M5 M9 T0 F254 S0]");
}

TEST(RefusedLine, of_a_controller_switches_and_sets_nothing) {
  GrblRun run;
  const auto told = [&] {
    run.replies.clear();
    std::string all;
    run.send("$G\n$#\n$$\n$N\n$I\n");
    for (int answers = 0; answers < 5;) {
      const std::string line = run.reply();
      if (line == "ok" || line.empty()) ++answers;
      all += line + "\n";
    }
    const std::string status = run.status();
    return all + status.substr(0, status.find("|Bf"));
  };
  run.send("G21 G1 X1 F600 S500\nM3\nM8\nG55\nG91\n");
  for (int i = 0; i < 5; ++i) EXPECT_EQ(run.reply(), "ok");
  ASSERT_TRUE(run.turn_until([&] { return run.is("Idle"); }));
  const std::string before = told();
  for (const char* const line : {"M5 X--2",         "M9 G1 X1 F-1",    "G54 G59 X1", "G90 M9 M5 P1",
                                 "G10 L2 P1 X5 R2", "G10 L2 P9 X5",    "G92",        "S0 M3 Q1",
                                 "G28.1 K1",        "G43.1 X1",        "T300",       "G0 G1 X5",
                                 "$10=x",           "$13=-1",          "$11=0",      "$100=5",
                                 "$N0=G1 X1 Q1",    "$N7=G0",          "$RST=x",     "$J=G91X1F0",
                                 "$J=G20X1F-1",     "$J=G90X9999F100", "$I2",        "$y",
                                 "M2 X1 Q5"}) {
    run.send(std::string(line) + "\n");
    const std::string answer = run.reply();
    EXPECT_TRUE(answer.starts_with("error:") || answer.starts_with("[MSG:")) << line << ": " << answer;
    EXPECT_EQ(told(), before) << line;
  }
}

}  // namespace
}  // namespace passo::test
