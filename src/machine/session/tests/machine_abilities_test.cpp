#include "passo/session/machine_abilities.hpp"

#include <set>

#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(MachineAbilities, are_complete_without_a_reason) {
  const MachineAbilities all;
  for (std::size_t i = 0; i < ability_count; ++i) EXPECT_TRUE(all.can(static_cast<Ability>(i)));
}

TEST(MachineAbilities, keep_the_first_reason) {
  MachineAbilities some;
  some.lack(Ability::home, {.code = "a", .text = "it has no switches"});
  some.lack(Ability::home, {.code = "b", .text = "another reason"});
  EXPECT_FALSE(some.can(Ability::home));
  EXPECT_TRUE(some.can(Ability::jog));
  ASSERT_NE(some.why_not(Ability::home), nullptr);
  EXPECT_EQ(some.why_not(Ability::home)->code, "a");
  EXPECT_EQ(some.lacking().size(), 1U);
}

TEST(MachineAbilities, have_different_names) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < ability_count; ++i) names.insert(name_of(static_cast<Ability>(i)));
  EXPECT_EQ(names.size(), ability_count);
  EXPECT_EQ(names.count(""), 0U);
}

}  // namespace
}  // namespace passo
