#include "passo/part_job/operation_order.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace passo {
namespace {

PartJob ordered_job(const std::string& operations) {
  Diagnostics findings;
  auto job = parse_part_job(
      "[job]\ndrawing = \"a.svg\"\n[stock]\nsize = [100, 60]\nthickness = 8\n"
      "[tool.1]\nshape = \"flat\"\ndiameter_mm = 6\n[tool.2]\nshape = \"flat\"\ndiameter_mm = 2\n"
      "[tool.3]\nshape = \"vee\"\ndiameter_mm = 6\nangle_deg = 90\n" +
          operations,
      "a.toml", findings);
  EXPECT_FALSE(findings.any_error()) << render(findings, false);
  return job.value_or(PartJob{});
}

std::string operation(const char* kind, const char* title, int tool, const char* more = "") {
  return std::string("[[operation]]\nkind = \"") + kind + "\"\ntitle = \"" + title +
         "\"\ntool = " + std::to_string(tool) + "\n" + more + "\n";
}

std::string titles(const PartJob& job) {
  std::string words;
  for (const OrderedOperation& ordered : order_operations(job)) {
    words += (words.empty() ? "" : " ") + job.operations[ordered.index].title;
  }
  return words;
}

TEST(OperationOrder, facing_is_first_and_what_frees_the_part_is_last) {
  const PartJob job =
      ordered_job(operation("profile", "out", 1) + operation("pocket", "pocket", 1) +
                  operation("profile", "hole", 1, "side = \"inside\"") + operation("face", "face", 1, "depth = -1"));
  EXPECT_EQ(titles(job), "face pocket hole out");
}

TEST(OperationOrder, operations_of_a_tool_follow_each_other) {
  const PartJob job =
      ordered_job(operation("pocket", "a", 1, "layer = \"a\"") + operation("pocket", "b", 2, "layer = \"b\"") +
                  operation("pocket", "c", 1, "layer = \"c\"") + operation("pocket", "d", 2, "layer = \"d\""));
  EXPECT_EQ(titles(job), "a c b d");
  EXPECT_EQ(tool_changes(job, order_operations(job)), 1U);
}

TEST(OperationOrder, the_wide_cutter_clears_before_the_narrow_one) {
  const PartJob job =
      ordered_job(operation("pocket", "fine", 2, "layer = \"a\"") + operation("pocket", "rough", 1, "layer = \"a\""));
  EXPECT_EQ(titles(job), "rough fine");
  EXPECT_EQ(order_operations(job).back().reason, "a wider cutter clears first");
}

TEST(OperationOrder, a_chamfer_comes_after_the_cuts_and_before_the_part_is_free) {
  const PartJob job = ordered_job(operation("profile", "out", 1) + operation("chamfer", "edge", 3, "depth = -1") +
                                  operation("pocket", "pocket", 1));
  EXPECT_EQ(titles(job), "pocket edge out");
}

TEST(OperationOrder, an_engraving_elsewhere_need_not_wait) {
  const PartJob job = ordered_job(operation("engrave", "ticks", 3, "layer = \"ticks\"") +
                                  operation("bore", "shaft", 2, "layer = \"shaft\"") +
                                  operation("profile", "out", 2, "layer = \"out\""));
  EXPECT_EQ(titles(job), "ticks shaft out");
  EXPECT_EQ(tool_changes(job, order_operations(job)), 1U);
}

TEST(OperationOrder, what_was_moved_has_a_reason_and_the_rest_has_none) {
  const PartJob job = ordered_job(operation("profile", "out", 1) + operation("pocket", "pocket", 1));
  const auto order = order_operations(job);
  EXPECT_EQ(order[0].reason, "");
  EXPECT_EQ(order[1].reason, "it frees the part, so it comes last");
}

TEST(OperationOrder, an_operation_that_is_moved_up_for_its_tool_has_a_reason) {
  const PartJob job =
      ordered_job(operation("profile", "out", 1) + operation("pocket", "pocket", 1) + operation("drill", "holes", 2));
  EXPECT_EQ(titles(job), "holes pocket out");
  const auto order = order_operations(job);
  EXPECT_EQ(order[0].reason, "fewer tool changes");
  EXPECT_EQ(order[1].reason, "");
}

TEST(OperationOrder, the_tool_that_clears_first_counts_as_a_change) {
  PartJob job = ordered_job(operation("engrave", "sign", 3, "clear-tool = 2") + operation("pocket", "pocket", 2));
  EXPECT_EQ(titles(job), "pocket sign");
  EXPECT_EQ(tool_changes(job, order_operations(job)), 1U);
  job.keeps_order = true;
  EXPECT_EQ(tool_changes(job, order_operations(job)), 2U);
}

TEST(OperationOrder, as_written_means_as_written) {
  PartJob job = ordered_job(operation("profile", "out", 1) + operation("pocket", "pocket", 1));
  job.keeps_order = true;
  EXPECT_EQ(titles(job), "out pocket");
}

// Every permutation of these results in an order that keeps all rules.
TEST(OperationOrder, the_order_does_not_depend_on_how_the_operations_were_written) {
  std::vector<std::string> operations = {operation("face", "face", 1, "depth = -1"), operation("pocket", "pocket", 2),
                                         operation("chamfer", "edge", 3, "depth = -1"), operation("profile", "out", 1)};
  std::sort(operations.begin(), operations.end());
  do {
    std::string text;
    for (const std::string& one : operations) text += one;
    EXPECT_EQ(titles(ordered_job(text)), "face pocket edge out");
  } while (std::next_permutation(operations.begin(), operations.end()));
}

}  // namespace
}  // namespace passo
