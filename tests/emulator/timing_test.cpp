// The emulator counts as the chip does: the figures in timing_program.S are the data sheet's.
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "passo/emulator/emulated_chip.hpp"

namespace passo {
namespace {

TEST(EmulatedChip, counts_the_cycles_of_the_data_sheet) {
  EmulatedChip chip(PASSO_TIMING_PROGRAM);
  std::vector<std::uint64_t> marks;
  int measured = 0;
  chip.on_write(0x3e, [&](std::uint8_t) { marks.push_back(chip.cycles()); });
  chip.on_write(0x4a, [&](std::uint8_t expected) {
    ++measured;
    ASSERT_EQ(marks.size(), 2U) << "measure " << measured;
    EXPECT_EQ(marks[1] - marks[0] - 1, expected) << "measure " << measured << " of timing_program.S";
    marks.clear();
  });
  chip.on_write(0x4b, [&](std::uint8_t) { chip.stop(); });
  chip.run(100'000);
  EXPECT_EQ(measured, 26);
}

TEST(EmulatedChip, says_what_is_wrong_with_a_program) {
  EXPECT_THROW(EmulatedChip("no such file.elf"), std::runtime_error);
  EXPECT_THROW(EmulatedChip(PASSO_TIMING_PROGRAM, "no such chip"), std::runtime_error);
  EmulatedChip chip(PASSO_TIMING_PROGRAM);
  EXPECT_THROW(chip.run(10'000), std::runtime_error) << "it does not stop by itself";
}

}  // namespace
}  // namespace passo
