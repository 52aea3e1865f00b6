#include "terminal.hpp"

#include <cstdlib>
#include <string_view>

#include <sys/ioctl.h>
#include <unistd.h>

namespace passo {

bool is_terminal(int descriptor) {
  return isatty(descriptor) != 0;
}

bool rewrites_lines(int descriptor) {
  const char* const kind = std::getenv("TERM");
  return is_terminal(descriptor) && (kind == nullptr || std::string_view(kind) != "dumb");
}

bool shows_colours(int descriptor) {
  const char* const unwanted = std::getenv("NO_COLOR");
  return rewrites_lines(descriptor) && (unwanted == nullptr || *unwanted == '\0');
}

std::size_t columns_of(int descriptor) {
  winsize size{};
  return ioctl(descriptor, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

}  // namespace passo
