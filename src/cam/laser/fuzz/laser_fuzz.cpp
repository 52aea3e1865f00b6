// Any bytes as a picture for a laser: what can be read becomes a program whose beam is off in rapids and at the end,
// and whose moves stay within the picture and the overscan.
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "../tests/beam_reader.hpp"
#include "kit/require.hpp"

#include "passo/laser/burned_picture.hpp"
#include "passo/laser/laser_raster.hpp"

namespace passo {
namespace {

using test::require;

void check_program(const LevelPicture& picture, std::uint8_t kind) {
  constexpr double widest = 300;  // cells; more would leave the readers little time
  const CellCount count = count_cells(picture, Mm(1 + kind % 30), Mm(0.1));
  if (count.columns > widest || count.rows > widest) return;
  ToneOptions tones;
  tones.mode = static_cast<ToneMode>(kind % 4);
  tones.invert = kind % 8 >= 4;
  tones.mirror_x = kind % 16 >= 8;
  tones.mirror_y = kind % 3 == 0;
  tones.least_percent = kind % 5;
  tones.gamma = 0.3 + kind % 7;
  RasterMoves moves;
  moves.is_along_y = kind % 32 >= 16;
  moves.is_one_way = kind % 64 >= 32;
  moves.overscan = overscan_for(moves.feed, MmPerSecond2(100 + kind));
  LaserProgram program({});
  const BeamCells cells =
      cells_of(picture, static_cast<std::size_t>(count.columns), static_cast<std::size_t>(count.rows), tones);
  burn_raster(program, cells, moves);
  const bool is_burned = program.totals().burned_nm > 0;
  const std::string text = program.finish();
  require(test::read_beam(text).faults.empty(), "the beam is on where it must be off");
  const double overscan = to_mm(moves.overscan).value();
  if (is_burned) {
    const DrawnBox& box = *program.totals().moved;
    require(to_mm(box.least.x).value() >= -overscan - 1e-6 && to_mm(box.least.y).value() >= -overscan - 1e-6,
            "too far");
    require(to_mm(box.most.x).value() <= count.columns * 0.1 + overscan + 1e-6, "too wide");
    require(to_mm(box.most.y).value() <= count.rows * 0.1 + overscan + 1e-6, "too high");
  }
  require(draw_burned(text, {.most_side = 100}).empty() == !is_burned, "no picture");
}

}  // namespace
}  // namespace passo

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace passo;
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  Diagnostics findings;
  const LevelPicture picture = read_picture_on_white("it", bytes, findings);
  if (picture.columns != 0) check_program(picture, data[size / 2]);
  return 0;
}
