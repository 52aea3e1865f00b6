// M6 on a machine that measures its tools. A fake setter answers the probe moves: it knows which tool is in the spindle
// and how high each one touches.
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include "passo/interpreter/frame.hpp"
#include "passo/interpreter/interpreter.hpp"
#include "passo/interpreter/tool_change_plan.hpp"

namespace passo {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

ToolChangePlan setter_plan() {
  ToolChangePlan plan;
  plan.safe_z = 20;
  plan.change_at = MachineXy{30, 10};
  plan.measure_at = MachineXy{-50, -60};
  plan.window_low = -40;
  plan.window_high = 0;
  plan.seek = MmPerSecond(10);
  plan.latch = MmPerSecond(1);
  plan.retract = 2;
  plan.run_down = Seconds(3);
  return plan;
}

// Runs a program, and plays machine, tool setter and operator.
class Shop {
 public:
  explicit Shop(ToolChangePlan plan) : plan_(std::make_shared<const ToolChangePlan>(std::move(plan))) {}

  std::map<std::int32_t, double> touches_at = {{1, -20}, {2, -12.5}, {3, -31}};  // machine Z, by tool
  std::vector<double> odd;  // contacts of the first probe moves instead; NaN: closed already; infinite: no touch
  bool answers = true;      // false: a check
  Dialect dialect = Dialect::linuxcnc;
  ToolTable table;
  SavedParameters saved;

  void run(const std::string& program) {
    InterpreterOptions options;
    options.tool_change = plan_;
    options.dialect = dialect;
    options.tools = table;
    options.parameters = saved;
    options.on_machine = true;
    StoredResults results;
    Interpreter interpreter(ProgramReader::from_text("t", program), options, diagnostics,
                            answers ? static_cast<const MachineResults&>(results) : no_answers());
    Operation operation;
    while (interpreter.next(operation)) {
      frame.follow(operation);
      if (const auto* probe = std::get_if<operation::StraightProbe>(&operation.what)) {
        results.record(touch(frame.machine_from_work(probe->end)));
      } else {
        see(operation);
      }
    }
    saved = interpreter.saved_parameters();
    tools = interpreter.tools();
  }

  Frame frame;
  Point machine;
  std::int32_t tool = 0;
  std::vector<std::string> events;
  std::vector<std::string> said;
  Diagnostics diagnostics;
  ToolTable tools;
  bool spindle = false;
  bool coolant = false;
  std::int32_t selected = 0;

 private:
  void see(const Operation& operation) {
    const auto go = [&](const Point& end, bool is_rapid) {
      const Point to = frame.machine_from_work(end);
      const bool across = to[Axis::x] != machine[Axis::x] || to[Axis::y] != machine[Axis::y];
      if (is_rapid && in_change_ && across) EXPECT_GE(to[Axis::z], plan_->safe_z);
      machine = to;
      events.push_back(fmt::format("X{:g} Y{:g} Z{:g}", std::round(to[Axis::x] * 1e6) / 1e6,
                                   std::round(to[Axis::y] * 1e6) / 1e6, std::round(to[Axis::z] * 1e6) / 1e6));
    };
    if (const auto* traverse = std::get_if<operation::StraightTraverse>(&operation.what))
      return go(traverse->end, true);
    if (const auto* feed = std::get_if<operation::StraightFeed>(&operation.what)) return go(feed->end, false);
    if (std::holds_alternative<operation::StartToolChange>(operation.what)) in_change_ = true;
    if (const auto* change = std::get_if<operation::ChangeTool>(&operation.what)) {
      tool = change->tool;
      events.push_back(fmt::format("{} {}", change->by_machine ? "has" : "ask", tool));
    }
    if (std::holds_alternative<operation::ProgramStop>(operation.what)) events.push_back("stop");
    if (const auto* dwell = std::get_if<operation::Dwell>(&operation.what))
      events.push_back(fmt::format("wait {:g}", dwell->time.value()));
    if (const auto* message = std::get_if<operation::Message>(&operation.what)) said.emplace_back(message->text);
    if (const auto* turn = std::get_if<operation::TurnSpindle>(&operation.what))
      spindle = turn->direction != SpindleDirection::off;
    if (const auto* flood = std::get_if<operation::SetFlood>(&operation.what)) coolant = flood->on;
    if (const auto* select = std::get_if<operation::SelectTool>(&operation.what)) selected = select->tool;
    if (const auto* mist = std::get_if<operation::SetMist>(&operation.what))
      events.push_back(mist->on ? "open" : "close");
    if (std::holds_alternative<operation::SetToolOffset>(operation.what) ||
        std::holds_alternative<operation::SetWorkOffset>(operation.what)) {
      in_change_ = false;
    }
  }

  ProbeOutcome touch(const Point& end) {
    EXPECT_FALSE(spindle) << "the spindle turns at the tool setter";
    EXPECT_FALSE(coolant) << "the coolant is on at the tool setter";
    ProbeOutcome outcome{.refused = false, .touched = true, .contact = machine, .rest = machine};
    double at = touches_at.at(tool);
    if (probes_ < odd.size()) at = odd[probes_];
    ++probes_;
    if (std::isnan(at)) {
      outcome.refused = true;
      outcome.touched = false;
      events.push_back("refused");
      return outcome;
    }
    outcome.touched = at >= end[Axis::z] && at <= machine[Axis::z];
    outcome.contact[Axis::z] = outcome.touched ? at : end[Axis::z];
    outcome.rest[Axis::z] = outcome.touched ? at - 0.3 : end[Axis::z];
    machine = outcome.rest;
    events.push_back(outcome.touched ? fmt::format("touch {:g}", at) : "nothing");
    return outcome;
  }

  std::shared_ptr<const ToolChangePlan> plan_;
  bool in_change_ = false;
  std::size_t probes_ = 0;
};

TEST(ToolChange, goes_up_asks_touches_twice_and_comes_back_over_the_work) {
  Shop shop(setter_plan());
  shop.run("G0 X5 Y6 Z3\nM3 S100\nT1 M6\nG0 X7\nM2\n");
  EXPECT_FALSE(shop.diagnostics.any_error());
  EXPECT_THAT(shop.events,
              ElementsAre("X5 Y6 Z3", "X5 Y6 Z20", "wait 3", "X30 Y10 Z20", "ask 1", "X-50 Y-60 Z20", "touch -20",
                          "X-50 Y-60 Z-18", "touch -20", "X-50 Y-60 Z20", "X5 Y6 Z20", "X7 Y6 Z20"));
  EXPECT_THAT(shop.said, ElementsAre("put tool 1 into the spindle, then continue"));
}

TEST(ToolChange, lengths_count_from_the_first_tool) {
  Shop shop(setter_plan());
  shop.run("T1 M6\nG0 Z1\nT2 M6\nG0 Z1\nM2\n");
  EXPECT_EQ(shop.tools.find(1)->offset[Axis::z], 0);
  EXPECT_EQ(shop.tools.find(2)->offset[Axis::z], 7.5);
  EXPECT_EQ(shop.machine[Axis::z], 8.5);
}

TEST(ToolChange, lengths_count_from_the_nose) {
  ToolChangePlan plan = setter_plan();
  plan.use = LengthUse::absolute;
  plan.setter_z = -80;
  Shop shop(plan);
  shop.run("T1 M6\nG43 H1\nG0 Z1\nM2\n");
  EXPECT_EQ(shop.tools.find(1)->offset[Axis::z], 60);
  EXPECT_EQ(shop.machine[Axis::z], 61);
}

TEST(ToolChange, moves_the_works_zero_until_the_program_ends) {
  ToolChangePlan plan = setter_plan();
  plan.use = LengthUse::work;
  Shop shop(plan);
  shop.run("G10 L2 P1 Z-5\nG10 L2 P2 Z-6\nT1 M6\nT2 M6\nG0 Z1\nG55\nG0 Z0\nT3 M6\nG0 Z0\nM2\n");
  EXPECT_THAT(shop.events, AllOf(Contains("X0 Y0 Z3.5"), Contains("X0 Y0 Z1.5")));  // -5 + 1 + 7.5, -6 + 7.5
  EXPECT_EQ(shop.machine[Axis::z], -17);                                            // -6 - 11
  EXPECT_EQ(shop.saved.at(5223), -5);
  EXPECT_EQ(shop.saved.at(5243), -6);
}

ToolChangePlan plan_of_way(ToolChangeWay way) {
  ToolChangePlan plan = setter_plan();
  plan.way = way;
  if (way == ToolChangeWay::rack) {
    plan.rack = {.pockets = 2, .first = {100, 50}, .step = {20, 0}, .z = -30, .feed = MmPerSecond(10)};
  }
  if (way == ToolChangeWay::macro) plan.macro = "G53 G0 X70\n";
  return plan;
}

TEST(ToolChange, asks_again_with_the_reason) {
  const double closed = std::nan("");
  const double never = -1e9;
  const std::vector<std::pair<std::vector<double>, std::string>> troubles = {
      {{never}, "touched nothing down to Z-40"},
      {{5}, "above the end of the window at Z0"},
      {{-20, never}, "not a second time"},
      {{closed}, "the tool setter is closed already"},
      {{-20, closed}, "did not open again"},
      {{-20, -20.15}, "2 touches differ by 0.150 mm, more than 0.1 mm"},
      {{-20, -19.85}, "2 touches differ by 0.150 mm"},
  };
  for (const ToolChangeWay way :
       {ToolChangeWay::setter, ToolChangeWay::plate, ToolChangeWay::rack, ToolChangeWay::macro}) {
    for (const auto& [odd, reason] : troubles) {
      SCOPED_TRACE(fmt::format("way {}, {}", static_cast<int>(way), reason));
      Shop well(plan_of_way(way));
      well.run("T1 M6\nG0 X1\nM2\n");
      Shop shop(plan_of_way(way));
      shop.odd = odd;
      shop.run("T1 M6\nG0 X1\nM2\n");
      EXPECT_THAT(shop.said, Contains(HasSubstr(reason)));
      EXPECT_EQ(std::ranges::count(shop.events, "ask 1"), std::ranges::count(well.events, "ask 1") + 1);
      EXPECT_EQ(shop.tools.find(1)->offset[Axis::z], 0);
      EXPECT_EQ(shop.machine, well.machine);
      EXPECT_FALSE(shop.diagnostics.any_error());
    }
  }
}

TEST(ToolChange, takes_the_mean_of_slow_touches_that_agree) {
  ToolChangePlan plan = setter_plan();
  plan.touches = 3;
  plan.agreement = 0.05;
  plan.use = LengthUse::absolute;
  plan.setter_z = -80;
  Shop shop(plan);
  shop.odd = {-20.01, -20, -20.02, -19.98};
  shop.run("T1 M6\nM2\n");
  EXPECT_NEAR(shop.tools.find(1)->offset[Axis::z], 60, 1e-9);
  EXPECT_EQ(std::ranges::count_if(shop.events, [](const std::string& event) { return event.starts_with("touch"); }), 4);
  Shop spread(plan);
  spread.odd = {-20.01, -20, -20.02, -20.07};
  spread.run("T1 M6\nM2\n");
  EXPECT_THAT(spread.said, Contains(HasSubstr("4 touches differ by 0.070 mm, more than 0.05 mm")));
  EXPECT_EQ(spread.tools.find(1)->offset[Axis::z], 60);  // of the second try
  Shop lost(plan);
  lost.odd = {-20, -20, -1e9};
  lost.run("T1 M6\nM2\n");
  EXPECT_THAT(lost.said, Contains(HasSubstr("but not a further time")));
}

TEST(ToolChange, gives_up_in_the_end) {
  Shop shop(setter_plan());
  shop.odd.assign(50, -1e9);
  shop.run("T1 M6\nG0 X1\nM2\n");
  EXPECT_EQ(shop.diagnostics.all().front().code, "gcode.tool-not-measured");
  EXPECT_EQ(shop.machine[Axis::z], 20);
  EXPECT_EQ(std::ranges::count(shop.events, "ask 1"), 10);
}

TEST(ToolChange, finds_a_tool_that_was_worn_or_pulled_out) {
  ToolChangePlan plan = setter_plan();
  plan.wear = 0.1;
  for (const auto& [now, words] :
       std::map<double, std::string>{{-20.5, "tool 1 is 0.500 mm shorter than before its use: it is worn, broken"},
                                     {-19.5, "tool 1 is 0.500 mm longer than before its use: it is pulled out"},
                                     {-1e9, "tool 1 touched nothing down to Z-40.000: it is broken"},
                                     {-20.05, ""}}) {
    for (const char* const end : {"T2 M6\nM2\n", "M2\n"}) {
      Shop shop(plan);
      shop.odd = {-20, -20, now, now};
      shop.run("T1 M6\nG0 X1\nM3 S1\nG1 X2 F100\n" + std::string(end));
      EXPECT_EQ(std::ranges::count(shop.events, "stop"), words.empty() ? 0 : 1) << words;
      if (!words.empty()) {
        EXPECT_THAT(shop.said, Contains(HasSubstr(words)));
      }
      EXPECT_FALSE(shop.diagnostics.any_error());
    }
  }
}

TEST(ToolChange, does_what_the_plan_says_with_the_first_tool) {
  ToolChangePlan plan = setter_plan();
  plan.first = FirstTool::loaded;
  Shop loaded(plan);
  loaded.run("T1 M6\nT2 M6\nM2\n");
  EXPECT_EQ(loaded.said.front(), "check that tool 1 is in the spindle, then continue");
  EXPECT_THAT(std::vector(loaded.events.begin(), loaded.events.begin() + 3),
              ElementsAre("X0 Y0 Z20", "ask 1", "X-50 Y-60 Z20"))
      << "asks over the work, not at the place for changes";
  EXPECT_THAT(loaded.events, AllOf(Contains("touch -20").Times(2), Contains("ask 2").Times(1)));

  plan.first = FirstTool::trusted;
  plan.use = LengthUse::absolute;
  plan.setter_z = -80;
  Shop trusted(plan);
  ASSERT_TRUE(trusted.table.add({.number = 1, .offset = [] {
                                   Point offset;
                                   offset[Axis::z] = 59;
                                   return offset;
                                 }()}));
  trusted.run("T1 M6\nG0 Z0\nM2\n");
  EXPECT_EQ(trusted.machine[Axis::z], 59);
  EXPECT_EQ(std::ranges::count(trusted.events, "ask 1"), 1);
  EXPECT_EQ(std::ranges::count(trusted.events, "touch -20"), 0);
}

TEST(ToolChange, takes_the_last_tool_out_without_measuring) {
  Shop shop(setter_plan());
  shop.run("T1 M6\nT0 M6\nM2\n");
  EXPECT_EQ(shop.said.back(), "take the tool out of the spindle, then continue");
  EXPECT_EQ(std::ranges::count(shop.events, "touch -20"), 2);
}

TEST(ToolChange, executes_the_other_words_of_the_block_when_the_tool_is_changed) {
  Shop shop(setter_plan());
  shop.run("T1 M6\nT2 M6 G43 H2 G0 Z1 M8\nM2\n");
  EXPECT_EQ(shop.machine[Axis::z], 8.5);
  EXPECT_EQ(shop.events.back(), "X0 Y0 Z8.5");
}

TEST(ToolChange, works_in_a_turned_and_shifted_system_and_in_inches) {
  Shop shop(setter_plan());
  shop.run("G10 L2 P1 X3 Y4 Z-7 R30\nG92 X1\nG20 G90\nG0 X1 Y1 Z1\nT1 M6\nG0 Z0\nM2\n");
  EXPECT_THAT(shop.events, Contains("X-50 Y-60 Z-18"));
  EXPECT_NEAR(shop.machine[Axis::z], -7, 1e-9);
}

TEST(ToolChange, is_a_word_of_the_grbl_dialect_where_the_machine_measures) {
  Shop shop(setter_plan());
  shop.dialect = Dialect::grbl;
  shop.run("G21\nT1 M6\nM6 T2\nG0 Z1\nM2\n");
  EXPECT_FALSE(shop.diagnostics.any_error()) << render(shop.diagnostics, false);
  EXPECT_EQ(shop.machine[Axis::z], 8.5);
}

TEST(ToolChange, asks_for_the_plate_and_takes_it_away) {
  ToolChangePlan plan = setter_plan();
  plan.way = ToolChangeWay::plate;
  plan.measure_at.reset();
  Shop shop(plan);
  shop.run("G10 L2 P1 X11 Y12\nT1 M6\nM2\n");
  EXPECT_THAT(shop.events, ElementsAre("X0 Y0 Z20", "X30 Y10 Z20", "ask 1", "X11 Y12 Z20", "stop", "touch -20",
                                       "X11 Y12 Z-18", "touch -20", "X11 Y12 Z20", "stop", "X0 Y0 Z20"));
}

TEST(ToolChange, puts_tools_into_the_rack_and_takes_them_from_it) {
  ToolChangePlan plan = setter_plan();
  plan.way = ToolChangeWay::rack;
  plan.rack = {.pockets = 2,
               .first = {100, 50},
               .step = {20, 0},
               .z = -30,
               .entry = {0, -25},
               .feed = MmPerSecond(10),
               .opens = ColletOutput::mist,
               .wait = Seconds(1)};
  Shop shop(plan);
  shop.run("T1 M6\nT2 M6\nT3 M6\nM2\n");
  EXPECT_FALSE(shop.diagnostics.any_error());
  const std::vector<std::string> first(shop.events.begin(), shop.events.begin() + 11);
  EXPECT_THAT(first, ElementsAre("X0 Y0 Z20", "X30 Y10 Z20", "ask 0", "X100 Y50 Z20", "open", "wait 1", "X100 Y50 Z-30",
                                 "close", "wait 1", "X100 Y25 Z-30", "has 1"));
  const auto put = std::ranges::find(shop.events, "X100 Y25 Z20", {});
  EXPECT_THAT(shop.said, ElementsAre("take the tool out of the spindle if there is one, then continue",
                                     "put tool 3 into the spindle, then continue"));
  EXPECT_NE(put, shop.events.end());
  EXPECT_THAT(shop.events, AllOf(Contains("has 2").Times(1), Contains("ask 3").Times(1)));
}

TEST(ToolChange, uses_no_length_that_nobody_has_measured) {
  ToolChangePlan plan = setter_plan();
  plan.use = LengthUse::absolute;
  Shop shop(plan);
  shop.run("T1 M6\nG43 H1\nG43 H2\nM2\n");
  ASSERT_EQ(shop.diagnostics.all().size(), 1U);
  EXPECT_EQ(shop.diagnostics.all().front().code, "gcode.tool-not-measured");
  EXPECT_EQ(shop.diagnostics.all().front().place.line, 3U);
}

TEST(ToolChange, refuses_the_coolant_that_opens_the_collet) {
  ToolChangePlan plan = setter_plan();
  plan.way = ToolChangeWay::rack;
  plan.rack = {.pockets = 2, .first = {100, 50}, .step = {20, 0}, .z = -30, .opens = ColletOutput::mist};
  Shop shop(plan);
  shop.run("T1 M6\nM3 S1000\nM8\nM7\nM2\n");
  ASSERT_EQ(shop.diagnostics.all().size(), 1U);
  EXPECT_EQ(shop.diagnostics.all().front().code, "gcode.collet-output");
  EXPECT_EQ(shop.diagnostics.all().front().place.line, 4U);
  plan.rack.opens = ColletOutput::flood;
  Shop flood(plan);
  flood.run("M7\nM9\nM8\nM2\n");
  ASSERT_EQ(flood.diagnostics.all().size(), 1U);
  EXPECT_EQ(flood.diagnostics.all().front().place.line, 3U);
}

TEST(ToolChange, calls_the_lines_of_a_changer_and_measures_behind_them) {
  ToolChangePlan plan = setter_plan();
  plan.way = ToolChangeWay::macro;
  plan.macro = "(MSG,from #5400 to #<_selected_tool>)\n(DEBUG,#5400 #<_selected_tool>)\nG53 G0 X70 Y80\nG91\n";
  Shop shop(plan);
  shop.touches_at[0] = 0;
  shop.run("G0 X5 Z1\nT1 M6\nT2 M6\nG0 Z1\nM2\n");
  EXPECT_FALSE(shop.diagnostics.any_error()) << render(shop.diagnostics, false);
  EXPECT_EQ(shop.tool, 2);
  EXPECT_EQ(std::ranges::count(shop.events, "X70 Y80 Z20"), 2);
  EXPECT_EQ(std::ranges::count(shop.events, "has 2"), 1);
  EXPECT_EQ(std::ranges::count(shop.events, "touch -12.5"), 2);
  EXPECT_EQ(shop.events.back(), "X5 Y0 Z8.5");  // over the work, and with the modes as before
  EXPECT_THAT(shop.said, Contains("0.000000 1.000000"));
  EXPECT_THAT(shop.said, Contains("1.000000 2.000000"));

  Shop beside(plan);
  beside.run("T1 M6 G0 X1\nM2\n");
  EXPECT_EQ(beside.diagnostics.all().front().code, "gcode.change-macro");
  plan.macro = "M6\nG53 G0 X[\n";
  Shop broken(plan);
  broken.run("T1 M6\nM2\n");
  EXPECT_EQ(broken.diagnostics.all().front().file, "[tool_change] of the machine file");
  plan.macro = "G53 G0 X70\nM2\n";
  Shop ends(plan);
  ends.run("T1 M6\nM2\n");
  EXPECT_EQ(ends.diagnostics.all().front().code, "gcode.change-macro");
}

Shop after_macro(const std::string& lines, const std::string& program, bool answers = true) {
  ToolChangePlan plan = plan_of_way(ToolChangeWay::macro);
  plan.macro = lines;
  Shop shop(plan);
  shop.touches_at[0] = 0;
  shop.answers = answers;
  shop.run(program);
  return shop;
}

TEST(ToolChange, restores_what_the_lines_of_a_changer_set) {
  const std::string program = "G21 G90 G55\nM8\nT1 M6 (the next one)\nT2 M6\nG0 X1 Z1\nG1 X2 F100\nM2\n";
  const Shop as_expected = after_macro("G53 G0 X70\n", program);
  for (const char* const lines :
       {"G20 G91 G59.3 G43.1 Z50\nF1\nT9\n", "M3 S800\nM7\nM8\n", "M9\n", "M71\nG91 G20\n", "G91\nM73\nG20\n",
        "G51 X0 Y0 Z0 P2\n", "M48\nM51 P1\nG18 G64 P1 G93\n", "M8\nG4 P1\nM9\n", "M6\n", "M61 Q0\n"}) {
    const Shop shop = after_macro("G53 G0 X70\n" + std::string(lines), program);
    SCOPED_TRACE(lines);
    EXPECT_FALSE(shop.diagnostics.any_error()) << render(shop.diagnostics, false);
    EXPECT_EQ(shop.machine, as_expected.machine);
    EXPECT_EQ(shop.selected, 2);
    EXPECT_EQ(shop.tool, 2);
    EXPECT_FALSE(shop.spindle);
    EXPECT_EQ(shop.tools.find(2)->offset[Axis::z], 7.5);
  }
}

TEST(ToolChange, waits_until_a_spindle_stops_that_the_lines_of_a_changer_have_left_on) {
  const Shop shop = after_macro("M3 S100\nG53 G0 X70\n", "T1 M6\nM2\n");
  EXPECT_THAT(shop.events, testing::IsSupersetOf({"X70 Y0 Z20", "has 1", "wait 3", "X-50 Y-60 Z20"}));
}

TEST(ToolChange, ends_if_the_lines_of_a_changer_leave_other_offsets_or_another_tool) {
  const std::vector<std::pair<std::string, std::string>> troubles = {
      {"G92 X5\n", "has changed the offset of G92"},
      {"G92.1\n", "has changed the offset of G92"},
      {"G10 L2 P1 Z-9\n", "has changed the offset of G54 (#5223)"},
      {"G10 L20 P9 X5\n", "has changed the offset of G59.3 (#5381)"},
      {"G10 L2 P2 R30\n", "has changed the offset of G55 (#5250)"},
      {"#5242=4\n", "has changed the offset of G55 (#5242)"},
      {"M61 Q9\n", "has put tool 9 into the spindle"},
      {"T3 M6\n", "has put tool 3 into the spindle"},
  };
  for (const bool answers : {false, true}) {
    for (const auto& [lines, reason] : troubles) {
      Shop shop = after_macro(lines + "G53 G1 Z-30 F100\nM3 S100\n", "G92 X1\nG0 Z1\nT1 M6\nG0 Z-5\nM2\n", answers);
      SCOPED_TRACE(lines);
      ASSERT_TRUE(shop.diagnostics.any_error());
      const Diagnostic& found = shop.diagnostics.all().front();
      EXPECT_EQ(found.code, "gcode.change-macro");
      EXPECT_THAT(found.message, HasSubstr(reason));
      EXPECT_EQ(found.file + ":" + std::to_string(found.place.line), "t:3");
      EXPECT_EQ(shop.machine[Axis::z], 20);
      EXPECT_FALSE(shop.spindle);
      EXPECT_EQ(shop.saved[5211], -1);  // G92 X1, as the program has set it
      EXPECT_EQ(shop.saved[5223], 0);
    }
  }
}

TEST(ToolChange, is_known_to_a_check_that_has_no_answers) {
  ToolChangePlan plan = setter_plan();
  plan.wear = 0.1;
  Shop shop(plan);
  shop.answers = false;
  shop.run("T1 M6\nG0 Z1\nT2 M6\nG0 Z1\nM2\n");
  EXPECT_FALSE(shop.diagnostics.any_error());
  EXPECT_THAT(shop.events, AllOf(Contains("ask 1").Times(1), Contains("ask 2").Times(1), Contains("stop").Times(0)));
  EXPECT_EQ(shop.machine[Axis::z], 20);
}

TEST(ToolChange, refuses_a_change_while_the_cutter_radius_is_compensated) {
  Shop shop(setter_plan());
  shop.run("T1 M6\nG41.1 D2 G1 X5 F100\nX10\nT2 M6\nM2\n");
  EXPECT_EQ(shop.diagnostics.all().front().code, "gcode.cutter-compensation");
  EXPECT_EQ(shop.diagnostics.all().front().place.line, 4U);
}

}  // namespace
}  // namespace passo
