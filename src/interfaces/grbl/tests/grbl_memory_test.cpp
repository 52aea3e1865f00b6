// What a Grbl controller keeps over a restart.
#include "passo/grbl/grbl_memory.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(GrblMemory, is_read_as_it_was_written) {
  const GrblMemory memory{
      .choices = {.status_mask = 1, .inches = true}, .build = "SHOP-2", .startup = {"G54G20", "$=X"}};
  EXPECT_EQ(read_grbl_memory(grbl_memory_text(memory)), memory);
  EXPECT_EQ(read_grbl_memory(grbl_memory_text({})), GrblMemory());
}

TEST(GrblMemory, of_a_damaged_text_has_what_is_whole) {
  const std::string text = grbl_memory_text({.choices = {}, .build = "SHOP", .startup = {"G54", "G20"}});
  for (std::size_t size = 0; size <= text.size(); ++size) {
    const GrblMemory memory = read_grbl_memory(text.substr(0, size));
    EXPECT_LE(memory.startup[1].size(), 3U);
  }
  EXPECT_EQ(read_grbl_memory("$10=999\n$10=x\n$N2=G0\n=\n\x01\n$I=a b\n$N0=" + std::string(80, 'G')), GrblMemory());
}

}  // namespace
}  // namespace passo
