#include "passo/report/chord_picture.hpp"

#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include <unistd.h>

#include "passo/geometry/bezier.hpp"
#include "passo/geometry/curve_in_space.hpp"
#include "passo/geometry/ellipse.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;

class ChordPicture : public testing::Test {
 protected:
  ~ChordPicture() override { fs::remove(path_); }

  std::string draw(const ChordDrawing& drawing, PictureFormat format) const {
    Result<OutputFile, OutputError> file = OutputFile::open(path_.string());
    EXPECT_TRUE(file.has_value());
    const PictureOptions options{.format = format, .program = "Chords", .machine = {}};
    EXPECT_TRUE(draw_chords(drawing, options, *file).has_value());
    EXPECT_TRUE(file->commit().has_value());
    std::stringstream bytes;
    bytes << std::ifstream(path_, std::ios::binary).rdbuf();
    return bytes.str();
  }

  fs::path path_ = fs::temp_directory_path() / ("passo-chords-" + std::to_string(getpid()));
};

ChordTolerance within(double mm) {
  return *ChordTolerance::of(Mm(mm));
}

Ellipse ellipse() {
  return *Ellipse::flat({}, Mm(40), Mm(15), {0.5}, {0}, {2 * std::numbers::pi});
}

TEST_F(ChordPicture, records_every_chord_and_the_nearest_place_of_it) {
  const ChordDrawing drawing = record_chords(ellipse(), within(0.5));
  EXPECT_EQ(drawing.ends.front(), drawing.ends.back());
  double farthest = 0;
  for (const ChordDrawing::Sample& sample : drawing.samples) {
    farthest = std::max(farthest, length(sample.curve - sample.chord));
  }
  EXPECT_LE(farthest, 0.5);
  EXPECT_GE(farthest, 0.45);
  EXPECT_EQ(nearest_of({0, 0, 0}, {10, 0, 0}, {3, 4, 0}), (Vector3{3, 0, 0}));
  EXPECT_EQ(nearest_of({0, 0, 0}, {10, 0, 0}, {-3, 4, 0}), (Vector3{0, 0, 0}));
  EXPECT_EQ(nearest_of({1, 1, 0}, {1, 1, 0}, {-3, 4, 0}), (Vector3{1, 1, 0}));
}

TEST_F(ChordPicture, is_drawn_in_both_formats_whatever_the_curve) {
  const QuadraticBezier flat = *QuadraticBezier::create({Vector3{0, 0, 0}, {10, 20, 0}, {20, 0, 0}});
  const Vector3 p = {1, 2, 3};
  const CubicBezier point = *CubicBezier::create({p, p, p, p});
  const CubicBezier upright = *CubicBezier::create({Vector3{0, 0, 0}, {0, 0, 1}, {0, 0, 2}, {0, 0, 3}});
  const CurveInSpace nothing = *CurveInSpace::of(Curve::line(Point{}, Point{}));
  for (const double tolerance : {1e-3, 0.1, 1000.0}) {
    for (const ChordDrawing& drawing :
         {record_chords(ellipse(), within(tolerance)), record_chords(flat, within(tolerance)),
          record_chords(point, within(tolerance)), record_chords(upright, within(tolerance)),
          record_chords(nothing, within(tolerance))}) {
      const std::string svg = draw(drawing, PictureFormat::svg);
      EXPECT_THAT(svg, testing::HasSubstr("</svg>"));
      EXPECT_THAT(svg, testing::Not(testing::HasSubstr("nan")));
      EXPECT_LT(svg.size(), 10'000'000U);
      EXPECT_THAT(draw(drawing, PictureFormat::png), testing::StartsWith("\x89PNG"));
    }
  }
}

}  // namespace
}  // namespace passo
