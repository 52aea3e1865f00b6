// Lines of a program that begin with `/`: an operator may have them left out (block delete).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace passo {

std::uint64_t count_deleted_lines(std::string_view text);
// The same program for whoever keeps only a text: these lines are comments. All lines keep their numbers.
std::string with_deleted_lines_as_comments(std::string_view text);

}  // namespace passo
