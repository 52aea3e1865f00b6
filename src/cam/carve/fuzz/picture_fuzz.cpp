// Any bytes as a picture: they are refused with a reason, or all levels are there; of small pictures a program is made.
#include <cstdint>
#include <string>
#include <string_view>

#include "kit/require.hpp"

#include "passo/carve/level_picture.hpp"
#include "passo/carve/relief_program.hpp"
#include "passo/carve/relief_surface.hpp"

namespace passo {
namespace {

using test::require;

void check_program(const LevelPicture& picture) {
  constexpr std::size_t few = 400;  // more would leave the readers little time
  if (picture.levels.size() > few) return;
  Diagnostics findings;
  const HeightGrid grid = relief_of(picture, {.width = Mm(20), .depth = Mm(4), .gamma = 1.5}, "it", findings);
  if (findings.any_error()) return;
  ReliefProgramOptions options;
  constexpr FinishStrategy ways[] = {FinishStrategy::both, FinishStrategy::spiral, FinishStrategy::contours};
  options.way = ways[picture.levels.front() % 3];
  options.finish.step_over = Mm(1);
  options.finish.removal = picture.levels.front() % 5 == 0 ? 100 : 0;
  options.roughing = ReliefRoughing{};
  options.roughing->way = picture.levels.back() % 2 == 0 ? RoughStrategy::offsets : RoughStrategy::rows;
  options.rest = ReliefRest{};
  std::string text;
  const ReliefReport report = write_relief(
      grid, options, [&](std::string_view part) { text += part; }, [](double) {}, true);
  require(text.find("nan") == std::string::npos && text.find("inf") == std::string::npos, "no number");
  require(!draw_carved(report.carved, grid.pitch_x, grid.pitch_y, 200).empty(), "no view");
}

}  // namespace
}  // namespace passo

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace passo;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  for (const PixelLevel level : {PixelLevel::luminance, PixelLevel::alpha}) {
    Diagnostics findings;
    const LevelPicture picture = read_level_picture("it", bytes, level, findings);
    test::require((picture.columns == 0) == findings.any_error(), "neither read nor refused");
    test::require(picture.levels.size() == picture.columns * picture.rows, "levels are missing");
    if (picture.columns != 0) check_program(picture);
  }
  return 0;
}
