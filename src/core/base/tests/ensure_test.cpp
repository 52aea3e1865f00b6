#include "passo/base/ensure.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(Ensure, ends_the_program_in_every_build_where_a_condition_is_false) {
  ensure(true);
  EXPECT_DEATH(ensure(false), "internal error, please report it: assertion failed at .*ensure_test.cpp");
}

}  // namespace
}  // namespace passo
