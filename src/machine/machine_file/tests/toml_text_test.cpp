// TomlText: values are set, and all else stays.
#include "passo/toml/toml_text.hpp"

#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "passo/machine_file/machine_description.hpp"

namespace passo {
namespace {

std::string set(const std::string& text, const std::string& path, const TomlText::Setting& setting) {
  auto toml = TomlText::read(text);
  EXPECT_TRUE(toml) << text;
  if (!toml) return "";
  const auto done = toml->set(path, setting);
  return done ? toml->text() : "refused: " + done.error().message;
}

TEST(TomlText, sets_a_value_and_keeps_its_comment_in_its_column) {
  EXPECT_EQ(set("a = 200     # turns\nb = 1\n", "a", 85.5), "a = 85.5    # turns\nb = 1\n");
  EXPECT_EQ(set("a = 2 # turns\n", "a", 1234.5), "a = 1234.5 # turns\n");
  EXPECT_EQ(set("a = 2# turns\n", "a", 12.0), "a = 12# turns\n");
  EXPECT_EQ(set("a = 'é' # é\nb = 2 # x\n", "a", "\"ö\\"), "a = \"\\\"ö\\\\\" # é\nb = 2 # x\n");
  EXPECT_EQ(set("\xEF\xBB\xBF"
                "a = 2\n",
                "a", 3.0),
            "\xEF\xBB\xBF"
            "a = 3\n");
}

TEST(TomlText, sets_values_of_every_kind) {
  EXPECT_EQ(set("a = 2\n", "a", true), "a = true\n");
  EXPECT_EQ(set("a = [1, 2] # low, high\n", "a", std::vector<double>{-1.5, 20}), "a = [-1.5, 20] # low, high\n");
  EXPECT_EQ(set("a = [\n 1,\n 2\n]\n", "a", std::vector<double>{3, 4}), "a = [3, 4]\n");
  EXPECT_EQ(set("a = { b = 1, c = 2 }\n", "a.b", 1e-7), "a = { b = 1e-07, c = 2 }\n");
}

TEST(TomlText, writes_a_new_key_below_the_last_one_of_its_table) {
  const std::string text =
      "name = \"m\"\n\n[axis.X] # first\n  a = 1 # one\n  # more to come\n\n[axis.X.home]\nb = 2\n";
  EXPECT_EQ(set(text, "axis.X.new", 3.0),
            "name = \"m\"\n\n[axis.X] # first\n  a = 1 # one\n  new = 3\n  # more to come\n\n[axis.X.home]\nb = 2\n");
  EXPECT_EQ(set(text, "axis.X.home.new", 3.0), text + "new = 3\n");
  EXPECT_EQ(set(text, "new", false),
            "name = \"m\"\nnew = false\n\n[axis.X] # first\n  a = 1 # one\n  # more to come\n\n[axis.X.home]\nb = 2\n");
  EXPECT_EQ(set("[a]\n[b]\nc = 1\n", "a.new", 3.0), "[a]\nnew = 3\n[b]\nc = 1\n");
  EXPECT_EQ(set("[b]\nc = 1", "b.d", 3.0), "[b]\nc = 1\nd = 3\n");
  EXPECT_EQ(set("[b]\r\nc = 1\r\n", "b.d", 3.0), "[b]\r\nc = 1\r\nd = 3\r\n");
  EXPECT_EQ(set("[b]\nc = 1\n", "a", 3.0), "a = 3\n[b]\nc = 1\n");
}

TEST(TomlText, knows_the_other_ways_to_write_a_table) {
  EXPECT_EQ(set("[axis.X]\ntorque.a = 1 # one\nb = 2\n", "axis.X.torque.c", 3.0),
            "[axis.X]\ntorque.a = 1 # one\ntorque.c = 3\nb = 2\n");
  EXPECT_EQ(set("[axis.X]\nhome = { a = 1 } # here\n", "axis.X.home.b", 3.0),
            "[axis.X]\nhome = { a = 1, b = 3 } # here\n");
  EXPECT_EQ(set("home = {}\n", "home.b", 3.0), "home = { b = 3 }\n");
  EXPECT_EQ(set("[axis.X.home]\na = 1\n", "axis.X.b", 3.0), "[axis.X.home]\na = 1\n\n[axis.X]\nb = 3\n");
}

TEST(TomlText, writes_a_new_table_at_the_end) {
  EXPECT_EQ(set("[axis.X]\na = 1\n", "axis.X.torque.b", 3.0), "[axis.X]\na = 1\n\n[axis.X.torque]\nb = 3\n");
  EXPECT_EQ(set("", "a.b", 3.0), "[a]\nb = 3\n");
  EXPECT_EQ(set("[axis.X]\nhome = { a = 1 }\n", "axis.X.home.c.d", 3.0), "[axis.X]\nhome = { a = 1, c.d = 3 }\n");
}

TEST(TomlText, refuses_what_would_break_the_file) {
  const std::string text = "a = 1\n[b]\nc = [1, # one\n 2]\n";
  EXPECT_EQ(set(text, "b", 1.0), "refused: b is a table");
  EXPECT_EQ(set(text, "a.c", 1.0), "refused: a is not a table");
  EXPECT_EQ(set(text, "b.c", std::vector<double>{1}), "refused: b.c is a list with comments inside");
  EXPECT_EQ(set(text, "a", std::numeric_limits<double>::infinity()), "refused: a must be finite");
  EXPECT_EQ(set(text, "a b", 1.0), "refused: 'a b' is not a key");
  EXPECT_EQ(set(text, "", 1.0), "refused: '' is not a key");
  std::string deep = "a";
  for (int i = 0; i < 100'000; ++i) deep += ".a";
  EXPECT_EQ(set(text, deep, 1.0), "refused: a key has more than 16 parts");
  EXPECT_FALSE(TomlText::read("a = = 1\n"));
}

TEST(TomlText, changes_one_line_of_an_example) {
  for (const char* name : {"strong-router", "uno", "pantograph"}) {
    std::ifstream file(std::string(PASSO_SOURCE_DIR) + "/examples/machines/" + name + ".toml");
    std::ostringstream bytes;
    bytes << file.rdbuf();
    const std::string before = bytes.str();
    const std::string after = set(before, "axis.Y.travel_mm", std::vector<double>{-312.5, 912.25});
    Diagnostics diagnostics;
    const auto machine = parse_machine(after, "m.toml", diagnostics);
    ASSERT_TRUE(machine) << render(diagnostics, false);
    EXPECT_EQ(machine->axes[1].travel_low, -312.5);
    std::istringstream old_lines(before);
    std::istringstream new_lines(after);
    int changed = 0;
    for (std::string a, b; std::getline(old_lines, a) && std::getline(new_lines, b);) changed += a != b ? 1 : 0;
    EXPECT_EQ(changed, 1);
    EXPECT_EQ(std::ranges::count(before, '\n'), std::ranges::count(after, '\n'));
  }
}

TEST(TomlText, tells_the_values_that_can_be_set_in_their_order) {
  const auto toml = TomlText::read(
      "name = \"m\"\n[b]\nlist = [1, 2.5]\npoints = [[1, 2]]\nday = 2020-01-01\n[a]\nin = { flag = true }\nn = 3\n");
  ASSERT_TRUE(toml);
  std::string told;
  for (const TomlText::Value& one : toml->values()) {
    // What is told can be set.
    auto again = *toml;
    EXPECT_TRUE(again.set(one.path, one.setting)) << one.path;
    told += one.path + " ";
  }
  EXPECT_EQ(told, "name b.list a.in.flag a.n ");
  EXPECT_EQ(std::get<std::vector<double>>(toml->values()[1].setting), (std::vector<double>{1, 2.5}));
  EXPECT_EQ(std::get<double>(toml->values()[3].setting), 3);
}

}  // namespace
}  // namespace passo
