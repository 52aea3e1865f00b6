#include "passo/machine_file/option_profile.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "kit/scratch_folder.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

class OptionProfile : public testing::Test {
 protected:
  std::optional<std::vector<OptionSection>> read(const std::string& text) {
    const std::filesystem::path path = test::scratch_folder() / "profile.toml";
    std::ofstream(path) << text;
    return read_option_profile(path.string(), {"isolate", "outline"}, found_);
  }
  Diagnostics found_;
};

TEST_F(OptionProfile, options_become_words) {
  const auto sections = read(
      "[isolate]\ntool = \"1,0.2\"\nwidth = 0.5\nclear = true\nconventional = false\n"
      "[outline]\ntab = [\"10,0\", \"20,0\"]\ntabs = 4\ndepth = -1.6\n");
  ASSERT_TRUE(sections);
  ASSERT_EQ(sections->size(), 2U);
  EXPECT_EQ(sections->at(0).name, "isolate");
  EXPECT_THAT(sections->at(0).words, testing::ElementsAre("--tool=1,0.2", "--width=0.5", "--clear"));
  EXPECT_THAT(sections->at(1).words, testing::ElementsAre("--tab=10,0", "--tab=20,0", "--tabs=4", "--depth=-1.6"));
}

TEST_F(OptionProfile, tells_unknown_tables_and_values_with_their_line) {
  EXPECT_FALSE(read("[isolat]\ntool = 1\n"));
  ASSERT_EQ(found_.errors(), 1U);
  EXPECT_EQ(found_.all()[0].code, "profile.unknown-table");
  EXPECT_EQ(found_.all()[0].place.line, 1U);
  EXPECT_FALSE(read("[isolate]\ntool = 2020-01-01\n"));
  EXPECT_EQ(found_.all().back().code, "profile.bad-value");
}

TEST_F(OptionProfile, tells_a_file_that_is_not_there) {
  EXPECT_FALSE(read_option_profile("/nowhere/profile.toml", {"isolate"}, found_));
  EXPECT_EQ(found_.all().at(0).code, "profile.unreadable");
}

}  // namespace
}  // namespace passo
