#include "passo/activity/go_to.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "passo/activity/program.hpp"

namespace passo {
namespace {

MachineDescription parking_machine(ParkDescription::AtEnd at_end = ParkDescription::AtEnd::stay) {
  MachineDescription machine;
  for (const Axis axis : {Axis::x, Axis::y, Axis::z, Axis::a}) {
    AxisDescription& one = machine.axes.emplace_back();
    one.axis = axis;
    one.steps_per_unit = 100;
    one.travel_low = axis == Axis::z ? -80 : 0;
    one.travel_high = axis == Axis::z ? 1 : 200;
    one.velocity = MmPerSecond(50);
    one.acceleration = MmPerSecond2(200);
  }
  machine.axes[2].home = {.toward_high = true, .switch_at = 1, .pull_off = 3};
  Point place;
  place[Axis::x] = 10;
  place[Axis::y] = 190;
  machine.park = {.place = place, .at_end = at_end};
  return machine;
}

std::string word_of(const Point& place) {
  std::string words;
  for (const Axis axis : {Axis::x, Axis::y, Axis::z, Axis::a}) {
    words += std::to_string(static_cast<int>(place[axis])) + " ";
  }
  return words;
}

// The ends of the moves of a program that starts at X50 Y60 Z-40.
std::vector<std::string> ends_of(const std::string& text, const MachineDescription& machine) {
  InterpreterOptions options;
  options.start[Axis::x] = 50;
  options.start[Axis::y] = 60;
  options.start[Axis::z] = -40;
  Diagnostics findings;
  std::vector<std::string> ends;
  const ProgramCheck check =
      check_program(ProgramReader::from_text("p.ngc", text), machine, options, findings, [&](const PathItem& one) {
        if (const auto* segment = std::get_if<Segment>(&one)) ends.push_back(word_of(segment->curve.end()));
      });
  EXPECT_TRUE(check.good && findings.all().empty()) << render(findings, false) << text;
  return ends;
}

using Ends = std::vector<std::string>;

TEST(GoTo, moves_z_to_the_top_first) {
  const MachineDescription machine = parking_machine();
  const SavedParameters saved = {{5161, 20}, {5162, 30}, {5163, -5}, {5164, 90}, {5181, 1}, {5182, 2}, {5183, -9}};
  Frame frame;
  Point zero;
  zero[Axis::x] = 70;
  zero[Axis::y] = 80;
  zero[Axis::z] = -60;
  frame.follow({operation::SetWorkOffset{.offset = zero}, {}});
  const auto ends = [&](Destination destination) {
    const auto text = go_to_program(destination, machine, saved, frame);
    EXPECT_TRUE(text) << text.error().text;
    return ends_of(text ? *text : std::string(), machine);
  };
  EXPECT_EQ(ends(Destination::park), (Ends{"50 60 -2 0 ", "10 190 -2 0 "}));
  EXPECT_EQ(ends(Destination::first_home), (Ends{"50 60 -2 0 ", "20 30 -2 90 ", "20 30 -5 90 "}));
  EXPECT_EQ(ends(Destination::second_home), (Ends{"50 60 -2 0 ", "1 2 -2 0 ", "1 2 -9 0 "}));
  EXPECT_EQ(ends(Destination::work_zero), (Ends{"50 60 -2 0 ", "70 80 -2 0 "})) << "stays above the work";
}

TEST(GoTo, is_refused_with_the_reason) {
  MachineDescription machine = parking_machine();
  const auto code = [&](Destination destination, const SavedParameters& saved) {
    const auto text = go_to_program(destination, machine, saved, {});
    return text ? std::string() : text.error().code;
  };
  EXPECT_EQ(code(Destination::first_home, {{5161, 201}}), "goto.outside");
  EXPECT_EQ(code(Destination::first_home, {{5163, -81}}), "goto.outside");
  const auto unset = go_to_program(Destination::second_home, machine, {}, {});
  ASSERT_TRUE(unset) << "a home that was never stored is machine zero";
  EXPECT_EQ(ends_of(*unset, machine), (Ends{"50 60 -2 0 ", "0 0 -2 0 "})) << "Z stays up";
  machine.park.place.reset();
  EXPECT_EQ(code(Destination::park, {}), "goto.no-park");
}

TEST(GoTo, has_a_name_for_each_place) {
  for (const Destination one : all_destinations()) EXPECT_EQ(destination_named(name_of(one)), one);
  EXPECT_EQ(all_destinations().size(), 4U);
  EXPECT_EQ(destination_named("home"), std::nullopt);
}

TEST(ProgramEnd, leaves_the_tool_where_the_machine_file_says) {
  using enum ParkDescription::AtEnd;
  const std::string text = "G21 G90\nG0 X60 Y70\nM2\n";
  EXPECT_EQ(ends_of(text, parking_machine(stay)), (Ends{"60 70 -40 0 "}));
  EXPECT_EQ(ends_of(text, parking_machine(rise)), (Ends{"60 70 -40 0 ", "60 70 -2 0 "}));
  EXPECT_EQ(ends_of(text, parking_machine(park)), (Ends{"60 70 -40 0 ", "60 70 -2 0 ", "10 190 -2 0 "}));
  EXPECT_EQ(ends_of("G21 G90\nG0 X60 Y70\nM30\n", parking_machine(park)).size(), 3U);
}

// Small programs end with '%', so that a macro or a frame does not send the tool away.
TEST(ProgramEnd, without_m2_moves_nothing) {
  const MachineDescription machine = parking_machine(ParkDescription::AtEnd::park);
  EXPECT_EQ(ends_of("%\nG21 G90\nG0 X60 Y70\n%\n", machine), (Ends{"60 70 -40 0 "}));
  const auto text = go_to_program(Destination::work_zero, machine, {}, {});
  ASSERT_TRUE(text);
  EXPECT_EQ(ends_of(*text, machine).size(), 2U);
}

}  // namespace
}  // namespace passo
