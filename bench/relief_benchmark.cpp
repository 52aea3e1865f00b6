// How long a relief takes: the places of a cutter, and whole programs by `passo cam relief`, with their memory.
//
//   build/release/bench/relief_benchmark                      the figures of docs/manual/relief.md
//   build/release/bench/relief_benchmark --write N FILE.png   the example's picture, N pixels a side
//
// The benchmark prints figures and decides nothing.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "cost.hpp"
#include "kit/level_png.hpp"

#include "passo/carve/dropped_cutter.hpp"
#include "passo/carve/level_picture.hpp"

namespace {

using namespace passo;
namespace fs = std::filesystem;

// The highest of eight petals: domes with a vein, around the middle.
double petals(double u, double v, double turned, double away, double length, double width) {
  double highest = 0;
  for (int i = 0; i < 8; ++i) {
    const double angle = turned + i * M_PI / 4;
    const double along = u * std::cos(angle) + v * std::sin(angle) - away;
    const double across = v * std::cos(angle) - u * std::sin(angle);
    const double out = along * along / (length * length) + across * across / (width * width);
    const double vein = 0.12 * std::exp(-across * across / 0.0003);
    if (out < 1) highest = std::max(highest, std::sqrt(1 - out) * (1 - vein));
  }
  return highest;
}

// A flower in rings of waves, within a frame. `u`, `v`: -1 to 1.
double flower(double u, double v) {
  const double away = std::hypot(u, v);
  const double ground = 0.12 + 0.05 * std::cos(50 * away) * std::clamp(3 * (away - 0.6), 0.0, 1.0);
  const double outer = 0.5 * petals(u, v, 0, 0.5, 0.32, 0.19);
  const double inner = 0.3 + 0.4 * petals(u, v, M_PI / 8, 0.29, 0.2, 0.12);
  const double bud =
      0.6 + 0.4 * std::sqrt(std::max(0.0, 1 - away * away / 0.018)) + 0.03 * std::cos(90 * u) * std::cos(90 * v);
  double level = std::max(ground, outer);
  if (inner > 0.3) level = std::max(level, inner);
  if (away * away < 0.018) level = std::max(level, bud);
  const double frame = std::clamp((std::max(std::abs(u), std::abs(v)) - 0.9) * 25, 0.0, 1.0);
  return std::clamp(level, 0.0, 1.0) * (1 - frame) + 0.9 * frame;
}

LevelPicture flower_picture(std::size_t side) {
  LevelPicture picture{.columns = side, .rows = side};
  picture.levels.reserve(side * side);
  const double last = static_cast<double>(side - 1) / 2;
  for (std::size_t y = 0; y < side; ++y) {
    for (std::size_t x = 0; x < side; ++x) {
      const double level = flower(static_cast<double>(x) / last - 1, 1 - static_cast<double>(y) / last);
      picture.levels.push_back(static_cast<std::uint16_t>(std::lround(level * 65535)));
    }
  }
  return picture;
}

int write_picture(std::size_t side, const char* path) {
  std::ofstream file(path, std::ios::binary);
  file << test::png_of_levels(flower_picture(side));
  return file ? 0 : 1;
}

HeightGrid flower_grid(std::size_t side, double pitch) {
  HeightGrid grid{.columns = side, .rows = side, .pitch_x = Mm(pitch), .pitch_y = Mm(pitch)};
  for (const std::uint16_t level : flower_picture(side).levels)
    grid.heights.push_back(grid_height(Mm(level / 65535.0 * 3 - 3)));
  return grid;
}

void drop(const char* text, std::size_t side, double pitch, unsigned threads) {
  const HeightGrid grid = flower_grid(side, pitch);
  const auto start = std::chrono::steady_clock::now();
  const double before = cpu_seconds(RUSAGE_SELF);
  const TipMap map = drop_everywhere(DroppedCutter(grid, *parse_cutter(text), -3), 0, 0, threads);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  const auto places = static_cast<double>(map.heights.size());
  std::printf("%-14s %5zu x %-5zu nodes, %5.3g mm apart, %u threads %7.3f s wall %7.3f s CPU %6.1f M places/s\n", text,
              side, side, pitch, threads, wall.count(), cpu_seconds(RUSAGE_SELF) - before, places / wall.count() / 1e6);
}

void carve(const fs::path& folder, const char* name, std::size_t side, const std::string& width,
           const std::vector<std::string>& options) {
  const std::string picture = (folder / (std::to_string(side) + ".png")).string();
  const std::string program = (folder / "relief.ngc").string();
  if (!fs::exists(picture)) write_picture(side, picture.c_str());
  std::vector<std::string> command = {PASSO_PROGRAM, "cam", "relief", picture, "--width", width, "-o", program};
  command.insert(command.end(), options.begin(), options.end());
  const double before = cpu_seconds(RUSAGE_CHILDREN);
  const Cost cost = cost_of(command);
  std::ifstream lines(program);
  const auto count = std::count(std::istreambuf_iterator<char>(lines), std::istreambuf_iterator<char>(), '\n');
  std::printf("%-44s %8.2f s wall %8.2f s CPU %7.0f MiB %9td lines %6.1f MB\n", name, cost.seconds,
              cpu_seconds(RUSAGE_CHILDREN) - before, cost.mebibytes, count,
              static_cast<double>(fs::file_size(program)) / 1e6);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 4 && std::strcmp(argv[1], "--write") == 0) {
    return write_picture(std::clamp<std::size_t>(std::strtoul(argv[2], nullptr, 10), 2, 8000), argv[3]);
  }
  const unsigned threads = std::max(1U, std::thread::hardware_concurrency());
  for (const char* cutter : {"ball:3", "flat:3", "vee:60:3", "bull:3:0.5", "taper:1:5:3"}) drop(cutter, 1000, 0.1, 1);
  drop("ball:3", 1000, 0.1, threads);
  drop("ball:3", 1000, 0.02, threads);
  const fs::path folder = fs::temp_directory_path() / ("passo-relief-" + std::to_string(getpid()));
  fs::create_directory(folder);
  carve(folder, "500 x 500, each row of pixels", 500, "100", {"--step", "0.201", "--pitch", "1"});
  carve(folder, "500 x 500, and the finished surface drawn", 500, "100",
        {"--step", "0.201", "--pitch", "1", "-p", (folder / "view.png").string()});
  carve(folder, "500 x 500, three cutters", 500, "100", {"--rough", "flat:6", "--rest", "ball:1"});
  carve(folder, "500 x 500, offsets, contours, rest", 500, "100",
        {"--rough", "flat:6", "--rough-way", "offsets", "--way", "contours", "--rest", "ball:1"});
  carve(folder, "500 x 500, two cutters, removal held", 500, "100",
        {"--rough", "flat:6", "--rough-removal", "3000", "--removal", "100", "--feed-most", "2000"});
  carve(folder, "4000 x 4000, each row of pixels", 4000, "400", {"--step", "0.1001", "--pitch", "1"});
  carve(folder, "4000 x 4000, three cutters, drawn", 4000, "400",
        {"--rough", "flat:6", "--rest", "ball:1", "-p", (folder / "view.png").string()});
  carve(folder, "4000 x 4000, offsets, contours", 4000, "400",
        {"--rough", "flat:6", "--rough-way", "offsets", "--way", "contours"});
  fs::remove_all(folder);
  return 0;
}
