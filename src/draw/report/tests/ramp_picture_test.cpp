#include "passo/report/ramp_picture.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace passo {
namespace {

namespace fs = std::filesystem;

class RampPicture : public testing::Test {
 protected:
  ~RampPicture() override { fs::remove(path_); }

  std::string draw(const RampScene& scene, PictureFormat format = PictureFormat::svg) const {
    auto file = OutputFile::open(path_.string());
    EXPECT_TRUE(file);
    const PictureOptions options{.format = format, .program = "A ramp", .machine = "a motor"};
    EXPECT_TRUE(draw_ramp_picture(scene, options, *file));
    EXPECT_TRUE(file->commit());
    std::ifstream stream(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  fs::path path_ = fs::temp_directory_path() / ("passo-ramp-picture-" + std::to_string(::getpid()));
};

// `scale` is that of each interval's error, in ticks.
RampTrace trace_of(std::size_t count, double scale) {
  RampTrace trace{.name = "a method", .samples = {}};
  double time = 0;
  for (std::size_t n = 0; n < count; ++n) {
    const double ticks = 1000 / std::sqrt(static_cast<double>(n) + 1);
    trace.samples.push_back({.n = static_cast<double>(n),
                             .begin = time,
                             .end = time + ticks * 1e-6,
                             .ticks = ticks,
                             .error = scale * std::sin(static_cast<double>(n))});
    time += ticks * 1e-6;
  }
  return trace;
}

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t found = 0;
  for (std::size_t i = text.find(word); i != std::string::npos; i = text.find(word, i + 1)) ++found;
  return found;
}

TEST_F(RampPicture, shows_a_curve_more_for_each_method) {
  RampScene scene{.traces = {trace_of(500, 10)}, .ideal = {{0, 0}, {0.04, 5000}}, .ideal_name = "ideal", .tick = 1e-6};
  const std::size_t one = count(draw(scene), "<path");
  scene.traces.push_back(trace_of(500, 20));
  const std::size_t two = count(draw(scene), "<path");
  EXPECT_GE(two, one + 4);  // rate, interval, error, legend
}

TEST_F(RampPicture, of_whatever_there_is_to_show_is_a_picture) {
  RampScene jerky{.traces = {trace_of(300, 0)}, .acceleration = {{0, 0}, {0.01, 50}, {0.02, -50}}, .tick = 1e-6};
  for (const RampScene& scene : {RampScene{}, RampScene{.traces = {trace_of(1, 0)}, .tick = 1e-6},
                                 RampScene{.traces = {trace_of(3, 1e9)}, .tick = 1}, jerky}) {
    const std::string svg = draw(scene);
    EXPECT_NE(svg.find("</svg>"), std::string::npos);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf\""), std::string::npos);
    EXPECT_EQ(draw(scene, PictureFormat::png).substr(1, 3), "PNG");
  }
}

}  // namespace
}  // namespace passo
