// The texts of tests/follower/vectors, which the build makes a part of the program.
#pragma once

#include <span>

namespace passo {

struct BoardVectorText {
  const char* name;  // "steps", "first_board/held"
  const char* text;
};
std::span<const BoardVectorText> board_vector_texts();

}  // namespace passo
