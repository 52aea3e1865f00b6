#include "passo/drive/script.hpp"

#include <string>

#include <gtest/gtest.h>

namespace passo {
namespace {

class ScriptTest : public testing::Test {
 protected:
  Script::Act say(char letter) {
    return [this, letter] { said_ += letter; };
  }
  Script script_;
  std::string said_;
};

TEST_F(ScriptTest, does_its_acts_in_order_and_waits_between_them) {
  bool settled = false;
  script_.then(say('a'));
  script_.until([&] { return settled; });
  script_.then(say('b'));
  EXPECT_FALSE(script_.go_on());
  EXPECT_FALSE(script_.go_on());
  EXPECT_EQ(said_, "a");
  settled = true;
  EXPECT_TRUE(script_.go_on());
  EXPECT_EQ(said_, "ab");
  EXPECT_TRUE(script_.empty());
}

TEST_F(ScriptTest, an_act_may_add_to_it) {
  script_.then([this] { script_.then(say('c')); });
  script_.then(say('b'));
  EXPECT_TRUE(script_.go_on());
  EXPECT_EQ(said_, "bc");
}

TEST_F(ScriptTest, an_act_may_clear_it) {
  script_.then([this] { script_.clear(); });
  script_.then(say('b'));
  EXPECT_TRUE(script_.go_on());
  EXPECT_EQ(said_, "");
}

TEST_F(ScriptTest, what_is_cleared_while_it_waits_is_not_done) {
  script_.until([] { return false; });
  script_.then(say('b'));
  EXPECT_FALSE(script_.go_on());
  script_.clear();
  EXPECT_TRUE(script_.go_on());
  EXPECT_EQ(said_, "");
}

}  // namespace
}  // namespace passo
