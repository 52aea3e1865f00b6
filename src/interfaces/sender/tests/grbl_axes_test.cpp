// Programs with more axes than X, Y and Z on boards that have them: each move ends where the program says, and takes as
// long, whatever way the board applies F to.
#include <numbers>

#include "fake_pair.hpp"
#include "grbl_program_lines.hpp"
#include "kit/example_machine.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passo/sender/grbl_forecast.hpp"
#include "passo/sender/grbl_machine_session.hpp"
#include "passo/sender/grbl_program_check.hpp"

namespace passo {
namespace {

using testing::Contains;
using testing::HasSubstr;

struct PlayedLine {
  double duration = 0;
  std::map<char, double> end;
  std::size_t moves = 0;
};

// The line to a fake, whose time passes while somebody waits.
class FirmwareFakePort final : public GrblPort {
 public:
  explicit FirmwareFakePort(test::FirmwareFake& board) : board_(board) {}
  Seconds now() const override { return now_; }
  void send(std::string_view bytes) override { board_.receive(bytes); }
  std::string receive(Seconds most) override {
    const Seconds step = std::min(most, Seconds(0.005));
    board_.run(step.value());
    now_ += step;
    return board_.take_output();
  }
  bool is_broken() const override { return false; }
  bool open_again() override { return false; }

 private:
  test::FirmwareFake& board_;
  Seconds now_{0};
};

class GrblAxes : public testing::Test {
 protected:
  static MachineDescription rotary() {
    MachineDescription machine = test::example_machine("router");
    AxisDescription a = machine.axes.front();
    a.axis = Axis::a;
    a.travel_low = -1e6;
    a.travel_high = 1e6;
    machine.axes.push_back(a);
    return machine;
  }
  static Diagnostics check(const test::FirmwareTraits& traits, const MachineDescription& machine,
                           const std::string& text) {
    FakePair pair(traits);
    Diagnostics findings;
    if (pair.greet()) {
      check_for_grbl(ProgramReader::from_text("part.ngc", text), machine, {}, GrblTarget::of(pair.sender.machine()),
                     findings);
    }
    return findings;
  }
  // Streams a program, and returns what the board made of each of its lines.
  static std::map<std::uint32_t, PlayedLine> played(FakePair& pair, const MachineDescription& machine,
                                                    const std::string& text) {
    std::map<std::uint32_t, PlayedLine> lines;
    EXPECT_TRUE(pair.greet());
    const ProgramReader reader = ProgramReader::from_text("part.ngc", text);
    const GrblTarget target = GrblTarget::of(pair.sender.machine());
    InterpreterOptions options;
    set_offsets(options, pair.sender.machine());
    options.start = *pair.sender.place();
    Diagnostics findings;
    EXPECT_TRUE(check_for_grbl(reader, machine, options, target, findings).good) << render(findings, false);
    test::GrblProgramLines program(reader, machine, options, target, false);
    std::vector<std::uint32_t> sources;
    const auto feed = [&] {
      while (pair.sender.wants_lines()) {
        const auto line = program.next();
        if (!line) return;
        if (!line->text.starts_with("G4P") && !line->text.starts_with('M')) sources.push_back(line->line);
        EXPECT_LT(line->text.size(), 80U) << line->text;
        pair.sender.add(line->text, line->line, line->silence);
      }
    };
    feed();
    EXPECT_TRUE(pair.play([&] { return (program.ended() && pair.sender.at_rest()) || pair.sender.stopped(); }, feed,
                          Seconds(100000)));
    EXPECT_FALSE(pair.sender.fault()) << pair.sender.fault()->message;
    const auto& moves = pair.board.moves();
    EXPECT_EQ(moves.size(), sources.size());
    for (std::size_t i = 0; i < std::min(moves.size(), sources.size()); ++i) {
      PlayedLine& line = lines[sources[i]];
      line.duration += moves[i].duration;
      line.end = moves[i].end;
      ++line.moves;
    }
    return lines;
  }
};

TEST_F(GrblAxes, a_wire_cuts_as_fast_as_its_program_says) {
  const std::string text =
      "G21 G90 G94\n"
      "G1 X10 Y5 U20 V5 F300\n"  // X Y count: 11.18 mm
      "X30 Y5 U20 V5\n"
      "U50\n"  // only U V move
      "G0 X0 Y5 U0 V5\n"
      "M2\n";
  for (const test::FirmwareTraits& traits : {test::grbl_mega_5x("XYUV"), test::grbl_mega_5x("XYZUV"),
                                             test::grblhal("XYZABCUV"), test::grblhal("XYZABCUV", true)}) {
    FakePair pair(traits);
    const auto lines = played(pair, test::example_machine("foam"), text);
    const std::string& name = pair.sender.machine().firmware;
    EXPECT_NEAR(lines.at(2).duration, std::hypot(10, 5) / 5, 1e-4) << name;
    EXPECT_NEAR(lines.at(3).duration, 4, 1e-4) << name;
    EXPECT_NEAR(lines.at(4).duration, 6, 1e-4) << name;
    EXPECT_EQ(lines.at(4).end.at('U'), 50) << name;
    EXPECT_EQ(lines.at(5).end.at('U'), 0) << name;
    EXPECT_EQ(lines.at(5).end.at('V'), 5) << name;
    EXPECT_NEAR((*pair.sender.place())[Axis::v], 5, 1e-3) << name;
  }
}

TEST_F(GrblAxes, a_turned_part_takes_the_programs_time_on_each_firmware) {
  const std::string text =
      "G21 G90 G94\n"
      "G1 X10 A90 F100\n"            // 10 mm at 100 mm/min
      "A270 F90\n"                   // 180 degrees at 90 degrees/min
      "G2 X20 Y0 I5 J0 A300 F600\n"  // half a circle of 15.7 mm
      "G93 G1 X0 A0 F2\n"            // half a minute
      "G94 G1 Y20 F1200\n"           // without the rotary axis
      "G3 X0 Y20 I0 J5 F600\n"       // a circle
      "M2\n";
  for (const test::FirmwareTraits& traits : {test::grbl_mega_5x("XYZA"), test::grblhal("XYZA"),
                                             test::grblhal("XYZA", true), test::fluidnc(4), test::ucnc(4)}) {
    FakePair pair(traits);
    const auto lines = played(pair, rotary(), text);
    const std::string& name = pair.sender.machine().firmware;
    EXPECT_NEAR(lines.at(2).duration, 6, 1e-3) << name;
    EXPECT_NEAR(lines.at(3).duration, 120, 1e-3) << name;
    EXPECT_NEAR(lines.at(4).duration, 5 * std::numbers::pi / 10, 2e-3) << name;
    EXPECT_GT(lines.at(4).moves, 10U) << name << ": chords";
    EXPECT_NEAR(lines.at(4).end.at('A'), 300, 1e-3) << name;
    EXPECT_NEAR(lines.at(5).duration, 30, 1e-3) << name;
    EXPECT_NEAR(lines.at(6).duration, 1, 1e-4) << name;
    EXPECT_NEAR(lines.at(7).duration, std::numbers::pi, 1e-3) << name;
    EXPECT_EQ(lines.at(7).moves, 2U) << name << ": arcs";
    const bool uses_inverse_time =
        std::ranges::any_of(pair.board.lines(), [](const std::string& line) { return line.starts_with("G93"); });
    EXPECT_EQ(uses_inverse_time, name == "grblHAL");
  }
}

// Grbl built for a CoreXY divides the way of the two motors by F.
TEST_F(GrblAxes, a_core_xy_moves_as_fast_as_the_program_says) {
  const std::string text =
      "G21 G90\n"
      "G1 X10 F600\n"
      "X20 Y10 Z10\n"
      "Z0\n"
      "G3 X20 Y30 I0 J10 Z5\n"
      "G18 G2 X10 Z5 I-5 K0\n"
      "M2\n";
  for (const bool is_core_xy : {false, true}) {
    test::FirmwareTraits traits = test::grbl_mega();
    traits.is_core_xy = is_core_xy;
    if (is_core_xy) traits.about.back() = "[OPT:VC,35,255]";
    FakePair pair(traits);
    const auto lines = played(pair, test::example_machine("router"), text);
    EXPECT_NEAR(lines.at(2).duration, 1, 1e-3);
    EXPECT_NEAR(lines.at(3).duration, std::sqrt(300) / 10, 1e-3);
    EXPECT_NEAR(lines.at(4).duration, 1, 1e-3);
    EXPECT_NEAR(lines.at(5).duration, std::hypot(10 * std::numbers::pi, 5) / 10, 2e-3);
    EXPECT_EQ(lines.at(5).moves, 1U);
    if (is_core_xy) EXPECT_NEAR(lines.at(6).duration, 5 * std::numbers::pi / 10, 2e-3) << "chords";
  }
}

TEST_F(GrblAxes, a_session_moves_all_axes_of_its_board) {
  const MachineDescription machine = rotary();
  test::FirmwareFake board(test::grblhal("XYZA"));
  board.restart();
  FirmwareFakePort port(board);
  GrblMachineSession session(machine, port);
  const auto play_until = [&](MachineState state) {
    for (const Seconds end = session.now() + Seconds(60); session.now() < end && session.state() != state;) {
      session.poll(Seconds(0.02));
      static_cast<void>(session.take_changes());
    }
    return session.state() == state;
  };
  ASSERT_TRUE(play_until(MachineState::idle));
  request::Start start{.program = ProgramReader::from_text("part.ngc", "G21 G90\nG1 X10 A90 F600\nM2\n"),
                       .options = {}};
  ASSERT_TRUE(session.request(std::move(start)));
  ASSERT_EQ(session.state(), MachineState::run);
  ASSERT_TRUE(play_until(MachineState::idle));
  ASSERT_FALSE(board.moves().empty());
  EXPECT_EQ(board.moves().back().end.at('A'), 90);
  double duration = 0;
  for (const auto& piece : board.moves()) duration += piece.duration;
  EXPECT_NEAR(duration, 1, 1e-3);
  EXPECT_NEAR(session.status().position.place[Axis::a], 90, 1e-3);
}

TEST_F(GrblAxes, an_axis_that_the_board_does_not_have_is_an_error_at_its_line) {
  const Diagnostics findings = check(test::grbl_mega(), rotary(), "G21\nG0 X1\nG0 A90\nM2\n");
  ASSERT_TRUE(findings.any_error());
  EXPECT_THAT(render(findings, false), HasSubstr("part.ngc:3"));
  EXPECT_THAT(render(findings, false), HasSubstr("it has no axis A"));
  EXPECT_FALSE(check(test::grblhal("XYZA"), rotary(), "G21\nG0 X1\nG0 A90\nM2\n").any_error());
}

TEST_F(GrblAxes, mist_is_an_error_before_the_start_where_the_board_has_none) {
  const std::string text = "G21\nM7\nG0 X1\nM2\n";
  EXPECT_THAT(render(check(test::grbl_mega(), rotary(), text), false), HasSubstr("without mist coolant (M7)"));
  EXPECT_FALSE(check(test::grblhal(), rotary(), text).any_error());
  EXPECT_FALSE(check(test::ucnc(), rotary(), text).any_error());
}

TEST_F(GrblAxes, that_a_program_does_not_use_are_not_written) {
  FakePair pair(test::grblhal("XYZABC"));
  played(pair, test::example_machine("router"), "G21\nG1 X10 Y5 F600\nM2\n");
  EXPECT_THAT(pair.board.lines(), Contains("G1F600X10Y5Z0"));
}

TEST_F(GrblAxes, the_offsets_of_all_axes_apply) {
  GrblMachine machine;
  machine.hear("[AXS:4:XYZA]");
  machine.hear("[G54:1.000,2.000,3.000,45.000]");
  machine.hear("[G59.3:7.000,0.000,0.000,8.000]");
  InterpreterOptions options;
  options.machine_units = LengthUnits::inch;
  set_offsets(options, machine);
  EXPECT_NEAR(options.parameters[5221], 1 / 25.4, 1e-12);
  EXPECT_EQ(options.parameters[5224], 45);
  EXPECT_EQ(options.parameters[5384], 8);
  const GrblTarget target = GrblTarget::of(machine);
  EXPECT_EQ(target.zero, (Point{{1, 2, 3, 45}}));
  EXPECT_TRUE(target.axes.has(Axis::a));
  EXPECT_FALSE(target.axes.has(Axis::b));
}

TEST_F(GrblAxes, the_forecast_knows_inverse_time) {
  GrblLimits limits;
  for (const Axis axis : {Axis::x, Axis::a}) {
    limits.steps_per_mm[axis] = 1000;
    limits.velocity[axis] = MmPerSecond(1000);
    limits.acceleration[axis] = MmPerSecond2(1e6);
  }
  GrblForecast forecast(limits, {.bytes_per_second = 0, .buffer = 128}, {}, {});
  forecast.add("G93G1F6X10A90", 1);
  forecast.add("G94F600X20", 2);
  EXPECT_NEAR(forecast.finish().time.value(), 10 + 1, 0.01);
}

}  // namespace
}  // namespace passo
