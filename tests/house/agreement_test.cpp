// Numbers that two modules know without knowing each other.
#include "passo/machine_file/machine_description.hpp"
#include "passo/wire/board_segment.hpp"

namespace passo {
namespace {

TEST(Agreement, a_machine_file_allows_as_many_motors_as_a_board_segment_carries) {
  EXPECT_EQ(most_motors, static_cast<std::size_t>(max_motors));
}

}  // namespace
}  // namespace passo
