#include "passo/spindle/vfd_table.hpp"

#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

using testing::HasSubstr;

std::string findings(std::string_view text) {
  Diagnostics diagnostics;
  std::string all;
  EXPECT_FALSE(parse_vfd_table(text, "drive.toml", diagnostics).has_value());
  for (const Diagnostic& one : diagnostics.all()) all += render(one, true) + one.code + "\n";
  return all;
}

constexpr std::string_view small_table =
    "name = \"My drive\"\n"
    "[speed]\nregister = 0x2001\nunit = \"hz\"\nscale = 100\n"
    "[forward]\nregister = 0x2000\nvalue = 0x12\n"
    "[stop]\nfunction = 5\nregister = 3\nvalue = 1\n"
    "[actual_speed]\nfunction = 4\nregister = 0x2103\nunit = \"rpm\"\n";

TEST(VfdTable, is_read_with_its_defaults) {
  Diagnostics diagnostics;
  const auto table = parse_vfd_table(small_table, "drive.toml", diagnostics);
  ASSERT_TRUE(table);
  EXPECT_EQ(table->name, "My drive");
  EXPECT_EQ(table->speed.function, 6);
  EXPECT_EQ(table->speed.address, 0x2001);
  EXPECT_TRUE(table->speed.is_in_hertz);
  EXPECT_EQ(table->speed.scale, 100);
  EXPECT_EQ(table->stop.function, 5);
  EXPECT_EQ(table->actual_speed.function, 4);
  EXPECT_FALSE(table->actual_speed.is_in_hertz);
  EXPECT_FALSE(table->reverse.has_value());
  EXPECT_FALSE(table->fault.has_value());
}

TEST(VfdTable, errors_name_their_line_and_what_was_expected) {
  const std::string lacks = findings("name = \"a\"\n");
  EXPECT_THAT(lacks, HasSubstr("a table [actual_speed]"));
  EXPECT_THAT(lacks, HasSubstr("vfd.missing-key"));
  const std::string wrong = findings(
      "name = \"a\"\n"
      "[speed]\nregister = 70000\nunit = \"khz\"\nfunction = 4\n"
      "[forward]\nregister = 1\nvalue = 1\n"
      "[stop]\nregister = 1\nvalue = 1\nvalu = 2\n"
      "[actual_speed]\nfunction = 6\nregister = 1\nunit = \"hz\"\n"
      "[fault_text]\novercurrent = \"3\"\n");
  EXPECT_THAT(wrong, HasSubstr("drive.toml:3:"));
  EXPECT_THAT(wrong, HasSubstr("\"hz\" or \"rpm\""));
  EXPECT_THAT(wrong, HasSubstr("6 (write a register) or 16 (write registers)"));
  EXPECT_THAT(wrong, HasSubstr("3 (read holding registers) or 4 (read input registers)"));
  EXPECT_THAT(wrong, HasSubstr("vfd.unknown-key"));
  EXPECT_THAT(wrong, HasSubstr("vfd.fault-text"));
}

TEST(VfdTable, a_file_that_is_not_there_is_named) {
  Diagnostics diagnostics;
  EXPECT_FALSE(load_vfd_table("/nowhere/drive.toml", diagnostics).has_value());
  ASSERT_EQ(diagnostics.all().size(), 1U);
  EXPECT_EQ(diagnostics.all()[0].file, "/nowhere/drive.toml");
}

TEST(VfdTable, the_example_is_valid) {
  Diagnostics diagnostics;
  const auto table = load_vfd_table(PASSO_SOURCE_DIR "/examples/drives/delta-ms300.toml", diagnostics);
  ASSERT_TRUE(table);
  EXPECT_TRUE(table->reverse && table->reset && table->current && table->fault);
  EXPECT_FALSE(table->timeout_setting.empty());
}

TEST(VfdTable, the_h100_runs_by_coils) {
  EXPECT_EQ(h100_table().forward.function, 5);
  EXPECT_EQ(h100_table().forward.address, 0x49);
  EXPECT_EQ(h100_table().reverse->address, 0x4A);
  EXPECT_EQ(h100_table().stop.address, 0x4B);
  EXPECT_EQ(h100_table().speed.address, 0x0201);
}

}  // namespace
}  // namespace passo
