#include "passo/machine_file/machine_kind.hpp"

#include <initializer_list>

#include <gtest/gtest.h>

namespace passo {
namespace {

MachineDescription machine_with(std::initializer_list<Axis> axes) {
  MachineDescription machine;
  for (const Axis axis : axes) machine.axes.emplace_back().axis = axis;
  return machine;
}

TEST(MachineKind, is_a_lathe_with_x_and_z_and_without_y) {
  EXPECT_TRUE(is_lathe(machine_with({Axis::x, Axis::z})));
  EXPECT_TRUE(is_lathe(machine_with({Axis::x, Axis::z, Axis::c})));
  EXPECT_FALSE(is_lathe(machine_with({Axis::x, Axis::y, Axis::z})));
  EXPECT_FALSE(is_lathe(machine_with({Axis::x, Axis::y})));
  EXPECT_FALSE(is_lathe(machine_with({Axis::z})));
}

}  // namespace
}  // namespace passo
