// What the DXF reader takes for holes and lines, beside what ezdxf makes of the same files. ezdxf is a library of its
// own, for Python; where it or Debian's librecad-data and openscad-testing-data are missing, this test is skipped.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "kit/in_full.hpp"
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "passo/cam/bulge.hpp"
#include "passo/cam/dxf.hpp"

namespace passo {
namespace {

namespace dxf_fs = std::filesystem;

std::vector<dxf_fs::path> some_drawings() {
  std::vector<dxf_fs::path> files;
  for (const char* const folder : {"/usr/share/librecad", "/usr/share/openscad/testdata"}) {
    if (!dxf_fs::exists(folder)) continue;
    for (const auto& entry : dxf_fs::recursive_directory_iterator(folder)) {
      if (entry.path().extension() == ".dxf") files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  std::vector<dxf_fs::path> some;
  for (std::size_t i = 0; i < files.size(); i += std::size_t{test::one_in(12)}) some.push_back(files[i]);
  return some;
}

struct DxfMeasure {
  std::size_t places = 0;
  double length = 0;  // in the file's unit
};
DxfMeasure measure_of(const Drawing& drawing) {
  DxfMeasure measure{.places = drawing.holes.size()};
  for (const DrawnHole& hole : drawing.holes) measure.length += M_PI * to_mm(hole.diameter).value();
  for (const DrawnPath& path : drawing.paths) {
    for (std::size_t i = 0; i + (path.is_closed ? 0 : 1) < path.points.size(); ++i) {
      const PathPoint& next = path.points[(i + 1) % path.points.size()];
      measure.length += way_nm(path.points[i].at, next.at, path.points[i].bulge) / nanometres_per_mm;
    }
  }
  return measure;
}

TEST(Ezdxf, has_the_same_holes_and_lines) {
  if (std::system("/usr/bin/python3 -c 'import ezdxf' > /dev/null 2>&1") != 0) GTEST_SKIP() << "no python3-ezdxf";
  const std::vector<dxf_fs::path> files = some_drawings();
  if (files.empty()) GTEST_SKIP() << "neither librecad-data nor openscad-testing-data is installed";
  const dxf_fs::path list = dxf_fs::temp_directory_path() / fmt::format("ezdxf-{}", ::getpid());
  std::ofstream names(list);
  for (const dxf_fs::path& file : files) names << file.string() << '\n';
  names.close();
  const std::string told = list.string() + ".told";
  ASSERT_EQ(std::system(fmt::format("/usr/bin/python3 {}/src/cam/cam/tests/dxf_by_ezdxf.py < {} > {}", PASSO_SOURCE_DIR,
                                    list.string(), told)
                            .c_str()),
            0);
  std::ifstream lines(told);
  std::size_t compared = 0;
  for (const dxf_fs::path& file : files) {
    std::string words;
    ASSERT_TRUE(std::getline(lines, words)) << file;
    std::ifstream stream(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    Diagnostics found;
    const Drawing drawing = read_dxf(file.string(), text, {.unit = Mm(1)}, found);
    if (words.starts_with("-") || found.any_error()) {
      fmt::print("{}: not compared: {}\n", file.string(), words);
      continue;
    }
    DxfMeasure theirs;
    std::istringstream(words) >> theirs.places >> theirs.length;
    const DxfMeasure ours = measure_of(drawing);
    EXPECT_EQ(ours.places, theirs.places) << file;
    EXPECT_NEAR(ours.length, theirs.length, 1e-3 * theirs.length + 1e-3) << file;
    ++compared;
  }
  dxf_fs::remove(list);
  dxf_fs::remove(told);
  fmt::print("{} drawings compared\n", compared);
  EXPECT_GT(compared * test::one_in(12), 1'000U);
}

}  // namespace
}  // namespace passo
