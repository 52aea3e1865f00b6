// Builds of the firmwares that differ in what they send: as their published sources do, by options and settings. A
// program runs on each without a fault, and a line that is lost is noticed.
#include "fake_pair.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

struct Build {
  const char* title;
  test::FirmwareTraits traits;
  const char* firmware;
  const char* axes = "XYZ";
};

test::FirmwareTraits uno() {
  test::FirmwareTraits traits = test::grbl_mega();
  traits.about = {"[VER:1.1h.20190830:]", "[OPT:V,15,128]"};
  traits.blocks = 15;
  traits.bytes = 128;
  return traits;
}

template <class Change>
test::FirmwareTraits changed(test::FirmwareTraits traits, Change change) {
  change(traits);
  return traits;
}

void set(test::FirmwareTraits& traits, const std::string& name, const std::string& value) {
  for (auto& setting : traits.settings) {
    if (setting.first == name) setting.second = value;
  }
}

// $10 with "parser state": grblHAL sends [GC:…] after each report before which a mode, F or S has changed.
void tell_modes(test::FirmwareTraits& traits) {
  set(traits, "10", "1023");
  traits.tells_modes = true;
}

// $Report/Interval=50: FluidNC reports by itself, and also its modes and offsets.
void report_by_itself(test::FirmwareTraits& traits) {
  traits.report_interval = 0.05;
  traits.tells_modes = true;
}

std::vector<Build> builds() {
  using Traits = test::FirmwareTraits;
  return {
      {"Grbl 1.1h", uno(), "Grbl"},
      {"REPORT_ECHO_LINE_RECEIVED", changed(uno(), [](Traits& of) { of.echoes = true; }), "Grbl"},
      {"lines that end with LF", changed(uno(), [](Traits& of) { of.line_end = "\n"; }), "Grbl"},
      {"lines that end with LF CR", changed(uno(), [](Traits& of) { of.line_end = "\n\r"; }), "Grbl"},
      {"$10 without Bf", changed(uno(), [](Traits& of) { of.shows_buffer = false; }), "Grbl"},
      {"all fields of Grbl 1.1",
       changed(uno(),
               [](Traits& of) {
                 of.more_of_reports = "|Ln:99999|Pn:XYZPDHRS|WCO:1.000,-2.000,0.000|Ov:100,100,100|A:SFM";
               }),
       "Grbl"},
      {"COREXY", changed(uno(), [](Traits& of) { of.about[1] = "[OPT:VCNMH,15,128]"; }), "Grbl"},
      {"Grbl_ESP32",
       changed(uno(),
               [](Traits& of) {
                 of.greeting = "Grbl 1.3a ['$' for help]";
                 of.about = {"[VER:1.3a.20210424:]", "[OPT:MPHS]", "[MSG:Using machine:Test Drive]"};
               }),
       "Grbl"},
      {"grbl-Mega", test::grbl_mega(), "grbl-Mega"},
      {"five axes with all fields",
       changed(test::grbl_mega_5x(),
               [](Traits& of) {
                 of.greeting = "Grbl 1.2h ['$' for help]";
                 of.more_of_reports = "|Pn:XYZABPDHRS|WCO:1.000,-2.000,0.000,90.000,0.000|A:CF";
               }),
       "grbl-Mega-5X", "XYZAB"},
      {"grblHAL, all fields",
       changed(test::grblhal("XYZA"),
               [](Traits& of) {
                 of.more_of_reports =
                     "|Pn:OXYZAPDHRSE|WCO:0.000,0.000,0.000,0.000|WCS:G54|Ov:100,100,100"
                     "|A:SEFMT|Sc:|MPG:0|H:1,15|D:0|T:3|TLR:0|In:-1|SD:3.5,part.nc|FW:grblHAL";
               }),
       "grblHAL", "XYZA"},
      {"grblHAL, parser state", changed(test::grblhal(), tell_modes), "grblHAL"},
      {"grblHAL, COMPATIBILITY_LEVEL 1",
       changed(test::grblhal(), [](Traits& of) { of.greeting = "Grbl 1.1f ['$' for help]"; }), "grblHAL"},
      {"grblHAL, COMPATIBILITY_LEVEL 10",
       changed(test::grblhal(),
               [](Traits& of) {
                 of.greeting = "Grbl 1.1f ['$' for help]";
                 of.answers.clear();
                 of.shows_buffer = false;
               }),
       "grblHAL"},
      {"FluidNC 3.9, Wi-Fi",
       changed(test::fluidnc(),
               [](Traits& of) {
                 of.greeting = "Grbl 3.9 [FluidNC v3.9.1 (wifi) '$' for help]";
                 of.about[0] = "[VER:3.9 FluidNC v3.9.1:]";
               }),
       "FluidNC"},
      {"FluidNC, $Start/Message of its owner",
       changed(test::fluidnc(), [](Traits& of) { of.greeting = "Workshop router 2"; }), "FluidNC"},
      {"FluidNC, $Report/Interval", changed(test::fluidnc(), report_by_itself), "FluidNC"},
      {"FluidNC, six axes by itself", changed(test::fluidnc(6), report_by_itself), "FluidNC", "XYZABC"},
      {"uCNC", test::ucnc(), "uCNC"},
  };
}

// Moves with another feed now and then, in both motion modes.
std::vector<std::string> program() {
  std::vector<std::string> lines = {"G1F1200X0.5Y0Z0"};
  for (int i = 1; i < 120; ++i) {
    std::string line = fmt::format("X{}Y{}", 0.5 * (i + 1), i % 3);
    if (i % 7 == 0) line += fmt::format("F{}", 600 + 10 * i);
    if (i % 10 == 0) line = "G0" + line;
    if (i % 10 == 1) line = "G1" + line;
    lines.push_back(line);
  }
  return lines;
}

// Streams the program and follows the board. `change` may take lines out of the bytes to the board.
void run(FakePair& pair, const std::function<std::string(std::string)>& change = {}) {
  pair.sender.follow(*pair.sender.place());
  const std::vector<std::string> lines = program();
  std::size_t next = 0;
  const Seconds end = pair.now + Seconds(120);
  while (pair.now < end && !pair.sender.stopped() && !(next == lines.size() && pair.sender.at_rest())) {
    for (; pair.sender.wants_lines() && next < lines.size(); ++next) {
      pair.sender.add(lines[next], static_cast<std::uint32_t>(next + 1));
    }
    std::string bytes = pair.sender.take_bytes(pair.now);
    pair.board.receive(change ? change(std::move(bytes)) : bytes);
    pair.board.run(0.005);
    pair.now += Seconds(0.005);
    pair.sender.receive(pair.board.take_output(), pair.now);
  }
  EXPECT_LT(pair.now, end);
}

TEST(GrblBuilds, each_is_recognized_and_runs_a_program_without_a_fault) {
  for (const Build& build : builds()) {
    SCOPED_TRACE(build.title);
    FakePair pair(build.traits);
    ASSERT_TRUE(pair.greet()) << pair.sender.fault().value_or(GrblFault{}).message;
    EXPECT_EQ(pair.sender.machine().firmware, build.firmware);
    EXPECT_EQ(pair.sender.machine().axes, build.axes);
    run(pair);
    EXPECT_FALSE(pair.sender.fault()) << pair.sender.fault()->code << ": " << pair.sender.fault()->message;
    EXPECT_FALSE(pair.board.overflowed());
    EXPECT_GE(pair.board.moves().size(), program().size()) << "long moves are sent in pieces";
    EXPECT_EQ(pair.board.moves().back().end.at('X'), 60);
  }
}

TEST(GrblBuilds, a_line_that_is_lost_is_noticed_on_each) {
  for (const Build& build : builds()) {
    for (const int lost : {3, 40, 119}) {
      SCOPED_TRACE(fmt::format("{}, line {}", build.title, lost));
      FakePair pair(build.traits);
      ASSERT_TRUE(pair.greet());
      int count = 0;
      run(pair, [&](const std::string& bytes) {
        std::string passed;
        for (std::size_t at = 0; at < bytes.size();) {
          const std::size_t end = std::min(bytes.find('\n', at), bytes.size() - 1) + 1;
          const std::string line = bytes.substr(at, end - at);
          const bool is_move = line.find('X') != std::string::npos;
          if (!is_move || ++count != lost) passed += line;
          at = end;
        }
        return passed;
      });
      ASSERT_TRUE(pair.sender.fault());
      EXPECT_THAT(pair.sender.fault()->code, testing::AnyOf("grbl.lost-lines", "grbl.off-path", "grbl.lost-bytes"));
    }
  }
}

TEST(GrblBuilds, a_changed_feed_is_noticed_where_modes_come_unasked) {
  for (const Build& build : builds()) {
    SCOPED_TRACE(build.title);
    FakePair pair(build.traits);
    ASSERT_TRUE(pair.greet());
    run(pair, [](std::string bytes) {
      const std::size_t at = bytes.find("F1090");
      return at == std::string::npos ? bytes : bytes.replace(at, 5, "F1890");
    });
    ASSERT_TRUE(pair.sender.fault());
    EXPECT_EQ(pair.sender.fault()->code, "grbl.changed-line");
  }
}

// With $13=1 FluidNC tells positions in inches, and F in millimetres.
TEST(GrblBuilds, a_feed_in_millimetres_beside_positions_in_inches_is_right) {
  GrblLimits limits;
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
    limits.steps_per_mm[axis] = 250;
    limits.velocity[axis] = MmPerSecond(100);
    limits.acceleration[axis] = MmPerSecond2(500);
  }
  GrblFollower follower(limits, {}, {}, Seconds(1));
  follower.sent("G1F600X1Y0Z0", 1, Seconds(0));
  const auto fits = [&](const char* modes) { return !follower.check_modes(modes, follower.modes(), true); };
  EXPECT_TRUE(fits("G1 G54 G17 G21 G90 G94 M5 M9 T0 F600.0 S0"));
  EXPECT_TRUE(fits("G1 G54 G17 G21 G90 G94 M5 M9 T0 F23.6 S0"));
  EXPECT_FALSE(fits("G1 G54 G17 G21 G90 G94 M5 M9 T0 F60.0 S0"));
}

}  // namespace
}  // namespace passo
