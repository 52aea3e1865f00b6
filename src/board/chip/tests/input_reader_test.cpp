#include "passo/chip/input_reader.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(InputReader, believes_a_machine_at_once) {
  InputReader reader;
  EXPECT_EQ(reader.update(input_probe, false), input_probe);
  EXPECT_EQ(reader.update(input_probe | input_limit, false), input_limit);
  EXPECT_EQ(reader.inputs(), input_probe | input_limit);
  EXPECT_EQ(reader.update(0, false), 0);
  EXPECT_EQ(reader.inputs(), 0);
}

TEST(InputReader, believes_a_person_who_holds_still) {
  InputReader reader;
  for (int bounce = 0; bounce < 20; ++bounce) {
    EXPECT_EQ(reader.update(bounce % 2 == 0 ? input_hold : 0, true), 0) << "a contact that bounces";
  }
  EXPECT_EQ(reader.update(input_hold, true), 0);
  EXPECT_EQ(reader.update(input_hold, false), 0) << "no time has passed";
  EXPECT_EQ(reader.update(input_hold, true), 0);
  EXPECT_EQ(reader.update(input_hold, true), 0);
  EXPECT_EQ(reader.update(input_hold, true), input_hold);
  EXPECT_EQ(reader.update(input_hold, true), 0) << "told once";
  EXPECT_EQ(reader.update(0, true), 0);
  EXPECT_EQ(reader.inputs(), input_hold) << "letting go bounces too";
}

}  // namespace
}  // namespace passo
