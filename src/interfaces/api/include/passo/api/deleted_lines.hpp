// Program lines that begin with `/`, which an operator can skip (block delete).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace passo {

std::uint64_t count_deleted_lines(std::string_view text);
// Returns the program with these lines turned into comments, for storage as plain text. All lines keep their numbers.
std::string with_deleted_lines_as_comments(std::string_view text);

}  // namespace passo
