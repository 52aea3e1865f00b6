#include "passo/base/result.hpp"

#include <memory>
#include <string>

namespace passo {
namespace {

Result<int, std::string> parse(bool good) {
  if (good) return 42;
  return Failure{std::string("no digits")};
}

TEST(Result, holds_the_value_on_success) {
  const auto result = parse(true);
  ASSERT_TRUE(result);
  EXPECT_EQ(*result, 42);
}

TEST(Result, holds_the_reason_on_failure) {
  const auto result = parse(false);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error(), "no digits");
}

TEST(Result, assignment_replaces_a_value_by_a_failure_and_back) {
  auto result = parse(true);
  result = parse(false);
  EXPECT_FALSE(result);
  result = parse(true);
  EXPECT_EQ(result.value(), 42);
}

TEST(Result, moves_what_cannot_be_copied) {
  Result<std::unique_ptr<int>, int> result = std::make_unique<int>(7);
  Result<std::unique_ptr<int>, int> moved = std::move(result);
  EXPECT_EQ(**moved, 7);
}

}  // namespace
}  // namespace passo
