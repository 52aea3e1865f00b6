#include "state_folder.hpp"

#include <cstdlib>
#include <filesystem>

namespace passo {

namespace fs = std::filesystem;

std::string state_folder() {
  // https://specifications.freedesktop.org/basedir-spec: a relative path is to be ignored.
  const char* const state = std::getenv("XDG_STATE_HOME");
  if (state != nullptr && *state == '/') return (fs::path(state) / "passo").string();
  const char* const home = std::getenv("HOME");
  if (home != nullptr && *home == '/') return (fs::path(home) / ".local" / "state" / "passo").string();
  return {};
}

}  // namespace passo
