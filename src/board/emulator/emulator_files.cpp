#include "passo/emulator/emulator_files.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;

// Test programs are in folders below the build folder, such as tests/emulator.
constexpr int deepest_program = 5;

}  // namespace

fs::path emulator_file(std::string_view name, const fs::path& from) {
  std::error_code none;
  fs::path installed = (from / PASSO_LIBEXEC_FROM_PROGRAM / name).lexically_normal();
  if (fs::exists(installed, none)) return installed;
  fs::path folder = from;
  for (int depth = 0; depth < deepest_program; ++depth, folder = folder.parent_path()) {
    if (!fs::exists(folder / "CMakeCache.txt", none)) continue;
    return fs::exists(folder / name, none) ? folder / name : fs::path();
  }
  return {};
}

fs::path emulator_file(std::string_view name) {
  std::error_code none;
  return emulator_file(name, fs::read_symlink("/proc/self/exe", none).parent_path());
}

}  // namespace passo
