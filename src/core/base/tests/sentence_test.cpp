#include "passo/base/sentence.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(Sentences, are_filled_with_their_arguments) {
  EXPECT_EQ(filled("the limit switch of {axis} closed", {{"axis", "X"}}), "the limit switch of X closed");
  EXPECT_EQ(filled("{first}, {second}", {{"second", "b"}, {"first", "{second}"}}), "{second}, b");
  EXPECT_EQ(filled("{unknown}; an open {brace", {}), "; an open ");
  EXPECT_EQ(filled("", {}), "");
}

}  // namespace
}  // namespace passo
