// The words for what has stopped a machine's motors.
#include "passo/session/stop_cause.hpp"

#include "kit/example_machine.hpp"
#include <gtest/gtest.h>

#include "passo/wire/message.hpp"

namespace passo {
namespace {

TEST(StopCauses, are_named) {
  const MachineDescription machine = test::example_machine("router");
  EXPECT_EQ(stop_cause(input_emergency_stop, machine).what, "the emergency stop was pressed");
  EXPECT_EQ(stop_cause(input_limit << 1, machine).what, "the limit switch of Y closed");
  EXPECT_EQ(stop_cause(input_limit << 1, machine).remedy, "jog off it (passo jog Y+2)");
  EXPECT_EQ(stop_cause(input_limit << 7, machine).what, "limit switch 8 closed");
  EXPECT_EQ(stop_cause(0, machine).remedy, "");
  EXPECT_EQ(stop_cause(0, machine).kind, StopCause::Kind::unknown);
  const StopCause cause = stop_cause(input_limit << 1, machine);
  EXPECT_EQ(cause.kind, StopCause::Kind::limit_switch_of_axis);
  EXPECT_EQ(cause.arguments, (SentenceArguments{{"axis", "Y"}}));
}

}  // namespace
}  // namespace passo
