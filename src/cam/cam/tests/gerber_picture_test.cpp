// What the reader takes for dark, pixel by pixel beside what gerbv draws of the same file. gerbv is a program of its
// own; where it is missing, these tests are skipped.
//
// PASSO_GERBER_FOLDER=FOLDER compares all files of a folder instead. PASSO_GERBER_PICTURES=FOLDER keeps pictures of
// what differs: red is ours alone, blue is gerbv's.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "kit/in_full.hpp"
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <png.h>

#include "passo/cam/excellon.hpp"
#include "passo/cam/gerber.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;

constexpr double nm_per_inch = 25.4e6;
constexpr int most_pixels = test::one_in(12) == 1 ? 2500 : 1600;  // along a side
// gerbv moves what it draws to whole pixels, so its picture is finer, and the middle one of 5 x 5 pixels is compared.
constexpr int finer = 5;

struct Bitmap {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> dark;  // row by row from above
};

Bitmap read_png(const fs::path& file) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  Bitmap bitmap;
  if (png_image_begin_read_from_file(&image, file.c_str()) == 0) return bitmap;
  image.format = PNG_FORMAT_GRAY;
  bitmap.width = static_cast<int>(image.width);
  bitmap.height = static_cast<int>(image.height);
  bitmap.dark.resize(PNG_IMAGE_SIZE(image));
  png_image_finish_read(&image, nullptr, bitmap.dark.data(), 0, nullptr);
  for (std::uint8_t& pixel : bitmap.dark) pixel = pixel > 127 ? 1 : 0;
  return bitmap;
}

Bitmap coarser(const Bitmap& fine) {
  Bitmap bitmap{fine.width / finer, fine.height / finer, {}};
  for (int y = 0; y < bitmap.height; ++y) {
    const std::size_t row = static_cast<std::size_t>(y * finer + finer / 2) * static_cast<std::size_t>(fine.width);
    for (int x = 0; x < bitmap.width; ++x)
      bitmap.dark.push_back(fine.dark[row + static_cast<std::size_t>(x * finer + finer / 2)]);
  }
  return bitmap;
}

// A pixel is dark if its middle is.
Bitmap bitmap_of(const Region& region, DrawnPoint corner, double nm_per_pixel, int width, int height) {
  std::vector<std::vector<double>> crossings(static_cast<std::size_t>(height));
  for (const DrawnRing& ring : region.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const auto along = [&](Nanometres value, Nanometres zero) {
        return static_cast<double>((value - zero).count) / nm_per_pixel;
      };
      double x1 = along(ring[i].x, corner.x);
      double y1 = along(ring[i].y, corner.y);
      double x2 = along(ring[(i + 1) % ring.size()].x, corner.x);
      double y2 = along(ring[(i + 1) % ring.size()].y, corner.y);
      if (y1 > y2) {
        std::swap(x1, x2);
        std::swap(y1, y2);
      }
      const int first = std::max(0, static_cast<int>(std::ceil(y1 - 0.5)));
      for (int row = first; row < height && row + 0.5 < y2; ++row) {
        const double x = x1 + (x2 - x1) * (row + 0.5 - y1) / (y2 - y1);
        crossings[static_cast<std::size_t>(height - 1 - row)].push_back(x);
      }
    }
  }
  Bitmap bitmap{width, height,
                std::vector<std::uint8_t>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height))};
  for (std::size_t row = 0; row < crossings.size(); ++row) {
    std::vector<double>& line = crossings[row];
    std::sort(line.begin(), line.end());
    for (std::size_t k = 0; k + 1 < line.size(); k += 2) {
      const int begin = std::max(0, static_cast<int>(std::ceil(line[k] - 0.5)));
      const int end = std::min(width, static_cast<int>(std::ceil(line[k + 1] - 0.5)));
      for (int x = begin; x < end; ++x)
        bitmap.dark[row * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] = 1;
    }
  }
  return bitmap;
}

// Whether a pixel near by has this colour too: then the difference is one of an edge that runs between two pixels.
bool is_near(const Bitmap& bitmap, int x, int y, std::uint8_t colour) {
  for (int row = std::max(0, y - 1); row <= std::min(bitmap.height - 1, y + 1); ++row) {
    for (int column = std::max(0, x - 1); column <= std::min(bitmap.width - 1, x + 1); ++column) {
      const auto at =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(bitmap.width) + static_cast<std::size_t>(column);
      if (bitmap.dark[at] == colour) return true;
    }
  }
  return false;
}

void keep_picture(const std::string& name, const Bitmap& ours, const Bitmap& theirs) {
  const char* const folder = std::getenv("PASSO_GERBER_PICTURES");
  if (folder == nullptr) return;
  std::vector<std::uint8_t> pixels;
  for (std::size_t i = 0; i < ours.dark.size(); ++i) {
    const bool a = ours.dark[i] != 0;
    const bool b = theirs.dark[i] != 0;
    const auto grey = static_cast<std::uint8_t>(a && b ? 150 : 255);
    pixels.push_back(b && !a ? 0 : a && !b ? 255 : grey);
    pixels.push_back(a != b ? 0 : grey);
    pixels.push_back(a && !b ? 0 : b && !a ? 255 : grey);
  }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.format = PNG_FORMAT_RGB;
  image.width = static_cast<png_uint_32>(ours.width);
  image.height = static_cast<png_uint_32>(ours.height);
  png_image_write_to_file(&image, (fs::path(folder) / (name + ".png")).c_str(), 0, pixels.data(), 0, nullptr);
}

std::string quoted(const fs::path& path) {
  return "'" + path.string() + "'";
}

// Compares one file. False: nothing could be compared.
bool compare(const fs::path& path) {
  // A hole wider than its aperture takes all away; gerbv fills what is outside.
  if (path.filename() == "rectangle.gbr" || path.filename() == "wide_oval.gbr") return false;
  std::ifstream stream(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!looks_like_gerber(text)) return false;
  Diagnostics found;
  const std::clock_t before = std::clock();
  const GerberLayer layer = read_gerber(path.filename().string(), text, found);
  const double seconds = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
  const std::string name = path.parent_path().filename().string() + "/" + path.filename().string();
  EXPECT_FALSE(found.any_error()) << name << "\n" << render(found, false);
  const std::optional<DrawnBox> box = bounds(layer.dark);
  if (!box) {
    fmt::print("{:60} empty\n", name);
    return false;
  }
  const double air = 0.02;  // inch
  const double wide = static_cast<double>((box->most.x - box->least.x).count) / nm_per_inch + 2 * air;
  const double high = static_cast<double>((box->most.y - box->least.y).count) / nm_per_inch + 2 * air;
  // 1200 dpi would put edges on a grid of inches right between two pixels.
  const double dpi = std::min(1171.0, std::floor(most_pixels / std::max(wide, high)));
  if (dpi < 1) return false;
  // gerbv wants its corner in inches: what it is told is what we draw.
  const double left = std::floor((static_cast<double>(box->least.x.count) / nm_per_inch - air) * 1e4) / 1e4;
  const double low = std::floor((static_cast<double>(box->least.y.count) / nm_per_inch - air) * 1e4) / 1e4;
  const auto whole = [dpi](double inches) { return (finer * std::ceil(inches * dpi) + 0.2) / (finer * dpi); };
  const fs::path png = fs::temp_directory_path() / fmt::format("gerber-picture-{}.png", ::getpid());
  const std::string command = fmt::format(
      "gerbv -x png -a -B 0 -D {} -O '{:.4f};{:.4f}' -W {:.6f}x{:.6f} -b '#000000' -f '#FFFFFFFF' -o {} {} > {}.log "
      "2>&1",
      finer * dpi, left, low, whole(wide), whole(high), quoted(png), quoted(path), quoted(png));
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  const Bitmap theirs = coarser(read_png(png));
  fs::remove(png);
  fs::remove(png.string() + ".log");
  if (theirs.dark.empty()) return false;
  Bitmap ours = bitmap_of(layer.dark, {{std::llround(left * nm_per_inch)}, {std::llround(low * nm_per_inch)}},
                          nm_per_inch / dpi, theirs.width, theirs.height);
  if (layer.is_negative) {
    for (std::uint8_t& pixel : ours.dark) pixel = pixel == 0 ? 1 : 0;
  }
  std::size_t differing = 0;
  std::size_t beyond_edges = 0;
  std::size_t dark = 0;
  for (std::size_t i = 0; i < ours.dark.size(); ++i) {
    dark += ours.dark[i];
    if (ours.dark[i] == theirs.dark[i]) continue;
    ++differing;
    const auto width = static_cast<std::size_t>(ours.width);
    const int x = static_cast<int>(i % width);
    const int y = static_cast<int>(i / width);
    const bool is_edge = is_near(theirs, x, y, ours.dark[i]) && is_near(ours, x, y, theirs.dark[i]);
    if (!is_edge) ++beyond_edges;
  }
  const double share = static_cast<double>(differing) / static_cast<double>(ours.dark.size());
  fmt::print("{:60} {:5} dpi {:5} x {:5}  dark {:5.1f} %  differs {:.4f} %, {} pixels beyond edges  read in {:.3f} s\n",
             name, dpi, ours.width, ours.height,
             100.0 * static_cast<double>(dark) / static_cast<double>(ours.dark.size()), share * 100, beyond_edges,
             seconds);
  for (const std::string& note : layer.strokes.notes) fmt::print("    {}\n", note);
  // Where many thin lines run along pixels, gerbv rounds each edge to one side: such a picture may differ more, by
  // edges.
  EXPECT_TRUE(share < 0.001 || beyond_edges == 0) << name;
  EXPECT_LT(share, 0.005) << name;
  if (share >= 0.001) keep_picture(path.filename().string(), ours, theirs);
  return true;
}

std::size_t compare_folder(const fs::path& folder, std::size_t every = 1) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::size_t compared = 0;
  for (std::size_t i = 0; i < files.size(); i += every) compared += compare(files[i]) ? 1U : 0U;
  return compared;
}

bool has_gerbv() {
  return std::system("gerbv --version > /dev/null 2>&1") == 0;
}

TEST(GerberPicture, is_that_of_gerbv) {
  if (!has_gerbv()) GTEST_SKIP() << "no gerbv";
  if (const char* const folder = std::getenv("PASSO_GERBER_FOLDER")) {
    EXPECT_GT(compare_folder(folder), 0U);
    return;
  }
  EXPECT_GT(compare_folder(fs::path(PASSO_SOURCE_DIR) / "examples/boards"), 0U);
}

TEST(GerberPicture, of_boards_of_other_projects_is_that_of_gerbv) {
  const fs::path peers = fs::path(PASSO_SOURCE_DIR) / "../shared/peers";
  if (!has_gerbv() || !fs::exists(peers)) GTEST_SKIP() << "no gerbv, or no " << peers;
  EXPECT_GT(compare_folder(peers / "boards", test::one_in(12)), 3U);
  EXPECT_GT(compare_folder(peers / "gerber", test::one_in(12)), 0U);
}

// All layers and drill files of npm's @tracespace/fixtures (scripts/fixtures.sh) are read without a fault.
TEST(Fixtures, of_many_layout_programs_are_read) {
  const fs::path folder = fs::path(PASSO_SOURCE_DIR) / "build/fixtures";
  if (!fs::exists(folder)) GTEST_SKIP() << "no " << folder << ": scripts/fixtures.sh fetches it";
  std::vector<fs::path> files;
  for (const char* const part : {"boards", "gerbers"}) {
    for (const auto& entry : fs::recursive_directory_iterator(folder / part)) {
      const std::string kind = entry.path().extension();
      if (entry.is_regular_file() && kind != ".svg" && kind != ".json") files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  std::size_t layers = 0;
  std::size_t drills = 0;
  for (std::size_t i = 0; i < files.size(); i += std::size_t{test::one_in(12)}) {
    std::ifstream stream(files[i], std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    Diagnostics found;
    if (looks_like_gerber(text)) {
      const GerberLayer layer = read_gerber(files[i].filename().string(), text, found);
      EXPECT_TRUE(!layer.dark.empty() || layer.pads.empty()) << files[i];
      ++layers;
    } else if (text.find("M48") != std::string::npos && text.find("M30") != std::string::npos) {
      const Drawing drawing = read_excellon(files[i].filename().string(), text, {}, found);
      EXPECT_FALSE(drawing.holes.empty() && drawing.paths.empty()) << files[i];
      ++drills;
    }
    EXPECT_FALSE(found.any_error()) << files[i] << "\n" << render(found, false);
  }
  EXPECT_GE(layers * test::one_in(12), 80U);
  fmt::print("{} layers, {} drill files\n", layers, drills);
}

}  // namespace
}  // namespace passo
