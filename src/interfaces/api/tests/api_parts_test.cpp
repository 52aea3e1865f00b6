// The parts of the API that need no machine: the members of a body, what a job has said, and offsets on a disk.
#include <string>
#include <utility>

#include "../api_json.hpp"
#include "../job_log.hpp"
#include "../json_members.hpp"
#include "../kept_offsets.hpp"
#include "../pressed_buttons.hpp"
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "passo/interpreter/saved_offsets.hpp"

namespace passo {
namespace {

MachineDescription two_axes() {
  MachineDescription machine;
  for (const Axis axis : {Axis::x, Axis::z}) machine.axes.emplace_back().axis = axis;
  return machine;
}

TEST(Findings, carry_the_sentences_of_their_texts) {
  constexpr SentenceRow row{"area.key", "{key} is {value}"};
  Diagnostic finding;
  finding.code = "area";
  finding.message = row.with({{"key", "X"}, {"value", "0"}});
  finding.expected = "a plain text";
  Diagnostics findings;
  findings.add(std::move(finding));
  const Json json = as_json(findings)[0];
  EXPECT_EQ(json["code"], "area");
  EXPECT_EQ(json["message"], "X is 0");
  EXPECT_EQ(json["message_sentence"]["code"], "area.key");
  EXPECT_EQ(json["message_sentence"]["arguments"], Json({{"key", "X"}, {"value", "0"}}));
  EXPECT_EQ(json["expected"], "a plain text");
  EXPECT_EQ(json["expected_sentence"]["code"], "");
}

// The times at which button 3 is pressed, in milliseconds. `closed`: when it is closed.
std::string presses(PressedButtons& buttons, const std::vector<std::pair<int, int>>& closed, int from, int to) {
  std::string all;
  for (int time = from; time < to; time += 5) {
    std::uint16_t inputs = 0x10;  // another one is closed
    for (const auto& [begin, end] : closed) inputs |= time >= begin && time < end ? 8 : 0;
    const std::uint16_t pressed = buttons.update(inputs, Seconds(time * 1e-3));
    EXPECT_EQ(pressed & ~8, 0);
    if (pressed != 0) all += std::to_string(time) + " ";
  }
  return all;
}

TEST(PressedButtons, count_once_however_they_bounce) {
  PressedButtons buttons;
  EXPECT_EQ(presses(buttons, {{2000, 2010}, {2020, 2300}, {2310, 2320}, {2400, 2500}}, 0, 3000), "2000 2400 ");
}

TEST(PressedButtons, do_not_count_if_they_are_held_at_the_beginning) {
  PressedButtons held;
  EXPECT_EQ(presses(held, {{0, 2000}, {2500, 2600}}, 0, 3000), "2500 ");
  PressedButtons late;
  EXPECT_EQ(presses(late, {{200, 2000}, {2500, 2600}}, 0, 3000), "2500 ") << "the board reports it late";
  late.forget();
  EXPECT_EQ(presses(late, {{3000, 5000}}, 3000, 6000), "");
}

TEST(JsonMembers, are_read_and_nothing_else_is_there) {
  const MachineDescription machine = two_axes();
  JsonMembers members(Json::parse(R"({"speed": 5, "on": true, "place": {"z": -2}, "left": null})"));
  EXPECT_EQ(members.number("speed"), 5.0);
  EXPECT_EQ(members.number("left"), std::nullopt) << "null is not said";
  EXPECT_EQ(members.number("other"), std::nullopt);
  EXPECT_EQ(members.flag("on"), true);
  Point start;
  start[Axis::x] = 7;
  const Point place = members.place("place", machine, start);
  EXPECT_EQ(place[Axis::x], 7.0);
  EXPECT_EQ(place[Axis::z], -2.0);
  EXPECT_TRUE(members.end()) << members.reason();
}

TEST(JsonMembers, that_nobody_asks_for_are_wrong) {
  JsonMembers members(Json::parse(R"({"on": true, "of": 1})"));
  members.flag("on");
  EXPECT_FALSE(members.end());
  EXPECT_EQ(members.reason(), "there is no \"of\"");
}

TEST(JsonMembers, tell_the_first_that_is_wrong) {
  const MachineDescription machine = two_axes();
  for (const char* place : {"5", "{}", R"({"y": 1})", R"({"x": "1"})", R"({"xz": 1})", "null"}) {
    JsonMembers members(Json::parse(fmt::format(R"({{"speed": "fast", "place": {}}})", place)));
    members.place("place", machine, Point());
    EXPECT_EQ(members.reason(), "\"place\": expected an object with a number for each axis") << place;
    members.number("speed");
    EXPECT_FALSE(members.end());
    EXPECT_EQ(members.reason(), "\"place\": expected an object with a number for each axis") << place;
  }
  JsonMembers list(Json::array());
  EXPECT_EQ(list.number("speed"), std::nullopt);
  EXPECT_FALSE(list.end());
  EXPECT_EQ(list.reason(), "the body is not a JSON object");
}

Operation said(auto what, std::uint32_t line) {
  Operation operation;
  operation.what = what;
  operation.source.line = line;
  return operation;
}

TEST(JobLog, has_what_was_said_with_its_line) {
  JobLog log;
  log.record(said(operation::Print{.text = "one"}, 3));
  log.record(said(operation::Log{.kind = operation::Log::Kind::open, .text = "file"}, 4));
  log.record(said(operation::Log{.text = "1,2"}, 5));
  log.record(said(operation::Message{.text = "two"}, 6));
  log.record(said(operation::Log{.text = "3,4"}, 7));
  EXPECT_EQ(log.lines(), "1,2\n3,4\n");
  ASSERT_EQ(log.json().size(), 4U) << "the name of a file is nothing said";
  EXPECT_EQ(log.json()[0], (Json{{"kind", "print"}, {"line", 3}, {"text", "one"}}));
  EXPECT_EQ(log.json()[2], (Json{{"kind", "message"}, {"line", 6}, {"text", "two"}}));
  log.clear();
  EXPECT_TRUE(log.json().empty());
}

TEST(JobLog, is_bounded) {
  JobLog log;
  const std::string text(1000, 'a');
  for (std::size_t i = 0; i < JobLog::most_words + 10; ++i) log.record(said(operation::Print{.text = text}, 1));
  const Json all = log.json();
  EXPECT_EQ(all.size(), JobLog::most_words);
  EXPECT_EQ(all.back()["text"].get<std::string>().size(), JobLog::longest_words);
}

// Offsets of programs, and a disk that may be full.
struct Disk {
  Disk() {
    options.parameters = {{work_offset_parameter(1), 4.0}};
    options.keep_offsets = [this](const SavedParameters& parameters, const ToolTable&) {
      ++writes;
      if (trouble.empty()) written = parameters;
      return trouble;
    };
  }
  std::string trouble;
  int writes = 0;
  SavedParameters written;
  ApiOptions options;
};

TEST(KeptOffsets, are_those_of_the_beginning_and_are_written_when_they_change) {
  Disk disk;
  ProgramStore programs;
  KeptOffsets offsets(programs, disk.options);
  EXPECT_EQ(programs.work_zero()[Axis::x], 4.0);
  SavedParameters found = programs.parameters();
  offsets.adopt(found, {});
  EXPECT_EQ(disk.writes, 0) << "nothing has changed";
  found[work_offset_parameter(1)] = 5;
  offsets.adopt(found, {});
  EXPECT_EQ(disk.writes, 1);
  EXPECT_EQ(disk.written, found);
  EXPECT_FALSE(offsets.adopt(found)) << "a sender's are the same";
  found[work_offset_parameter(1)] = 6;
  EXPECT_TRUE(offsets.adopt(found));
  EXPECT_EQ(programs.work_zero()[Axis::x], 6.0);
  EXPECT_EQ(disk.writes, 1) << "the sender keeps them";
}

TEST(KeptOffsets, without_a_tool_table_have_no_tools) {
  Disk disk;
  ProgramStore programs;
  KeptOffsets offsets(programs, disk.options);
  ToolTable tools;
  tools.name = "of a program";
  ASSERT_TRUE(tools.add({.number = 3, .pocket = 3}));
  offsets.adopt(programs.parameters(), tools);
  EXPECT_EQ(programs.tools().find(3), nullptr);
}

TEST(KeptOffsets, of_a_zero_that_cannot_be_written_stay_as_before) {
  Disk disk;
  ProgramStore programs;
  KeptOffsets offsets(programs, disk.options);
  disk.trouble = "no space left on device";
  Point zero;
  zero[Axis::x] = 9;
  EXPECT_FALSE(offsets.set_work_zero(zero));
  EXPECT_EQ(programs.work_zero()[Axis::x], 4.0);
  EXPECT_EQ(offsets.trouble(), disk.trouble);
  EXPECT_FALSE(offsets.write_again());
  disk.trouble.clear();
  EXPECT_TRUE(offsets.write_again());
  EXPECT_TRUE(offsets.set_work_zero(zero));
  EXPECT_EQ(programs.work_zero()[Axis::x], 9.0);
  EXPECT_EQ(disk.written, programs.parameters());
  const int writes = disk.writes;
  EXPECT_TRUE(offsets.write_again());
  EXPECT_EQ(disk.writes, writes) << "all was on the disk";
}

}  // namespace
}  // namespace passo
