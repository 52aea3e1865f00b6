#include "passo/pendant/pendant_table.hpp"

#include <algorithm>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

const std::string small = R"(name = "Small"
[usb]
vendor = 0x1234
product = 1
[report]
length = 4
[wheel]
byte = 1
[steps]
positions = [[0, 0.01, 5], [1, 0.1, 20]]
[keys]
bit_bytes = [2, 3]
[key.Go]
bit = 9
action = "go:park"
)";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

// "code line:column" of each finding.
std::string findings_of(const std::string& text) {
  Diagnostics diagnostics;
  const auto table = parse_pendant_table(text, "mine.toml", diagnostics);
  EXPECT_EQ(table.has_value(), !diagnostics.any_error());
  std::string found;
  for (const Diagnostic& one : diagnostics.all()) {
    EXPECT_FALSE(one.expected.empty()) << one.code;
    found += one.code + " " + std::to_string(one.place.line) + ":" + std::to_string(one.place.column) + "\n";
  }
  return found;
}

TEST(PendantTable, describes_a_pendant) {
  Diagnostics diagnostics;
  const auto table = parse_pendant_table(small, "mine.toml", diagnostics);
  ASSERT_TRUE(table) << render(diagnostics, false);
  EXPECT_EQ(table->vendor, 0x1234);
  EXPECT_EQ(table->length, 4U);
  EXPECT_FALSE(table->wheel->is_counter);
  ASSERT_EQ(table->steps.size(), 2U);
  EXPECT_DOUBLE_EQ(table->steps[1].share, 0.2);
  ASSERT_EQ(table->keys.all.size(), 1U);
  EXPECT_EQ(table->keys.all[0].action.kind, PendantAction::Kind::go);
  EXPECT_EQ(table->keys.all[0].action.word, "park");
}

TEST(PendantTable, knows_the_usual_pendants) {
  const auto all = known_pendants();
  ASSERT_EQ(all.size(), 3U) << "a table of examples/pendants has errors";
  const auto ids = [&](std::uint16_t vendor, std::uint16_t product) {
    return std::ranges::any_of(all,
                               [&](const PendantTable& one) { return one.vendor == vendor && one.product == product; });
  };
  EXPECT_TRUE(ids(0x10CE, 0xEB93));
  EXPECT_TRUE(ids(0x0B33, 0x0020));
  EXPECT_TRUE(ids(0x0B33, 0x0030));
  EXPECT_EQ(all[0].keys.all.size(), 16U);
  EXPECT_EQ(all[2].keys.all.size(), 15U);
}

TEST(PendantTable, names_what_is_wrong_and_where) {
  EXPECT_EQ(findings_of(small), "");
  EXPECT_EQ(findings_of(replaced(small, "byte = 1", "byte = 4")), "pendant.byte 8:8\n");
  EXPECT_EQ(findings_of(replaced(small, "\"go:park\"", "\"go\"")), "pendant.action 15:10\n");
  EXPECT_EQ(findings_of(replaced(small, "bit = 9", "bit = 16")), "pendant.out-of-range 14:7\n");
  EXPECT_EQ(findings_of(replaced(small, "0.1, 20", "0.001, 20")), "pendant.steps 10:13\n") << "descending";
  EXPECT_EQ(findings_of(replaced(small, "0.1, 20", "0.1, 1")), "pendant.steps 10:13\n") << "too slow";
  EXPECT_EQ(findings_of(replaced(small, "0.1, 20", "0.1")),
            "pendant.no-steps 7:1\npendant.wrong-list 10:13\npendant.steps 10:13\n");
  EXPECT_EQ(findings_of(replaced(small, "bit_bytes", "code_byte")),
            "pendant.keys 11:2\npendant.unknown-key 12:1\npendant.missing-key 13:6\npendant.unknown-key 14:1\n");
  EXPECT_EQ(findings_of(replaced(small, "vendor = 0x1234", "vendor = 0x12345")), "pendant.out-of-range 3:10\n");
  EXPECT_EQ(findings_of(replaced(small, "byte = 1", "byte = 1\nkind = \"round\"")), "pendant.wheel 9:8\n");
  EXPECT_EQ(findings_of(replaced(small, "length = 4", "length = 65")).substr(0, 24), "pendant.out-of-range 6:1");
}

TEST(PendantTable, has_steps_for_a_wheel) {
  EXPECT_EQ(findings_of(replaced(small, "[steps]\npositions = [[0, 0.01, 5], [1, 0.1, 20]]\n", "")),
            "pendant.no-steps 7:1\n");
}

TEST(PendantTable, takes_any_bytes) {
  for (std::size_t at = 0; at < small.size(); at += 3) {
    std::string text = small;
    text[at] = static_cast<char>(at * 37);
    Diagnostics diagnostics;
    static_cast<void>(parse_pendant_table(text, "mine.toml", diagnostics));
    static_cast<void>(parse_pendant_table(text.substr(0, at), "mine.toml", diagnostics));
  }
}

TEST(PendantAction, has_an_operand_only_if_it_needs_one) {
  using Kind = PendantAction::Kind;
  EXPECT_EQ(parse_pendant_action("stop")->kind, Kind::stop);
  EXPECT_EQ(parse_pendant_action("macro:probe-z")->word, "probe-z");
  EXPECT_EQ(parse_pendant_action("zero:Z")->axis, Axis::z);
  EXPECT_FALSE(parse_pendant_action("zero")->axis);
  for (const char* wrong : {"", "stopp", "stop:1", "macro", "macro:", "axis", "axis:Q", "axis:XY", "zero:"}) {
    EXPECT_FALSE(parse_pendant_action(wrong)) << wrong;
  }
  EXPECT_THAT(pendant_actions_in_words(), testing::HasSubstr("macro:NAME"));
}

}  // namespace
}  // namespace passo
