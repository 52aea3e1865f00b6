#include "passo/path/hand_tool_change.hpp"

#include "path_test.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

class HandToolChangeTest : public PathTest {
 protected:
  // The tools of the actions that change the tool, in order.
  std::vector<std::int32_t> changes() {
    std::vector<std::int32_t> tools;
    for (const PathItem& item : build()) {
      const auto* action = std::get_if<Action>(&item);
      if (action != nullptr && changes_tool(*action)) tools.push_back(action->tool);
    }
    return tools;
  }
};

TEST_F(HandToolChangeTest, is_a_t_word_and_then_m0) {
  feed(10);
  add(operation::SelectTool{2});
  add(operation::ProgramStop{});
  go(1, 0);
  add(operation::SelectTool{7});
  add(operation::StraightTraverse{xyz(0, 0, 20)});
  add(operation::ProgramStop{});
  go(2, 0);
  EXPECT_EQ(changes(), (std::vector<std::int32_t>{2, 7}));
}

TEST_F(HandToolChangeTest, is_no_stop_after_a_feed_and_no_t_word_alone) {
  feed(10);
  add(operation::SelectTool{2});
  go(1, 0);
  add(operation::ProgramStop{});
  add(operation::SelectTool{3});
  EXPECT_TRUE(changes().empty());
}

TEST_F(HandToolChangeTest, a_program_with_m6_only_selects_its_next_tool_by_t) {
  feed(10);
  add(operation::SelectTool{1});
  add(operation::ChangeTool{1});
  add(operation::SelectTool{2});
  add(operation::ProgramStop{});
  go(1, 0);
  EXPECT_EQ(changes(), std::vector<std::int32_t>{1});
}

TEST_F(HandToolChangeTest, the_texts_of_an_operator_name_the_tool_in_a_comment) {
  feed(10);
  add(operation::Message{" tool 4: drill, 3 mm"});
  add(operation::ProgramStop{});
  go(1, 0);
  EXPECT_EQ(changes(), std::vector<std::int32_t>{4});
}

TEST(HandToolChanges, read_the_comments_of_passo_cam) {
  EXPECT_EQ(tool_named_in("tool 2: flat end, 5 mm"), 2);
  EXPECT_EQ(tool_named_in("MSG, tool 12: drill"), 12);
  EXPECT_EQ(tool_named_in("tool: T6 \"one flute\", flat end, 3 mm"), 6);
  EXPECT_EQ(tool_named_in("Tool 1: of another program, which may call it later"), 0);
  EXPECT_EQ(tool_named_in("tool 6 mm end mill"), 0);
  EXPECT_EQ(tool_named_in("tool: 6 mm"), 0);
  EXPECT_EQ(tool_named_in("tool 0: none"), 0);
  EXPECT_EQ(tool_named_in("tool 99999999999: none"), 0);
  EXPECT_EQ(tool_named_in(""), 0);
  EXPECT_EQ(tool_named_in("tool"), 0);
}

TEST(HandToolChanges, name_the_first_tool_before_the_first_feed_only) {
  HandToolChange change;
  change.watch({.what = operation::Comment{"tool 3: flat end, 3 mm"}, .source = {}});
  EXPECT_EQ(change.at_start(), 3);
  change.watch({.what = operation::StraightFeed{}, .source = {}});
  change.watch({.what = operation::Comment{"tool 4: flat end, 6 mm"}, .source = {}});
  EXPECT_EQ(change.at_start(), 3);
}

}  // namespace
}  // namespace passo
