#include "passo/report/motor_picture.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "chart.hpp"
#include <png.h>
#include <unistd.h>

namespace passo {
namespace {

namespace fs = std::filesystem;

struct Pixels {
  unsigned width = 0;
  unsigned height = 0;
  std::vector<png_byte> bytes = {};  // red, green, blue

  // Whether the pixel, or a neighbour of it, has that colour.
  bool has(Spot spot, const Colour& colour) const {
    const auto middle_x = static_cast<int>(spot.x);
    const auto middle_y = static_cast<int>(spot.y);
    for (int y = middle_y - 1; y <= middle_y + 1; ++y) {
      for (int x = middle_x - 1; x <= middle_x + 1; ++x) {
        if (x < 0 || y < 0 || x >= static_cast<int>(width) || y >= static_cast<int>(height)) continue;
        const png_byte* pixel = &bytes[3 * (static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x))];
        const auto near = [](png_byte byte, double part) { return std::abs(byte - 255 * part) < 2; };
        if (near(pixel[0], colour.red) && near(pixel[1], colour.green) && near(pixel[2], colour.blue)) return true;
      }
    }
    return false;
  }
};

class MotorPicture : public testing::Test {
 protected:
  ~MotorPicture() override { fs::remove(path_); }

  template <class Draw>
  std::string written(const Draw& draw) {
    auto file = OutputFile::open(path_.string());
    EXPECT_TRUE(file) << file.error().message;
    const Status<OutputError> drawn = draw(*file);
    EXPECT_TRUE(drawn) << drawn.error().message;
    EXPECT_TRUE(file->commit());
    std::ifstream stream(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  std::string draw(const MotorScene& scene, PictureFormat format) {
    PictureOptions options;
    options.format = format;
    options.program = "A motor";
    return written([&](OutputFile& file) { return draw_motor_picture(scene, options, file); });
  }
  static Pixels decode(const std::string& bytes) {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    EXPECT_NE(png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()), 0) << png.message;
    png.format = PNG_FORMAT_RGB;
    Pixels pixels{png.width, png.height, std::vector<png_byte>(PNG_IMAGE_SIZE(png))};
    EXPECT_NE(png_image_finish_read(&png, nullptr, pixels.bytes.data(), 0, nullptr), 0) << png.message;
    return pixels;
  }

  fs::path path_ = fs::temp_directory_path() / ("passo-motor-picture-" + std::to_string(getpid()));
};

TorqueCurve curve(const std::vector<TorquePoint>& points) {
  return *TorqueCurve::from_points({.steps_per_revolution = 200, .inertia = {5e-6}}, points);
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t i = text.find(part); i != std::string::npos; i = text.find(part, i + 1)) ++found;
  return found;
}

TEST_F(MotorPicture, a_chart_draws_its_curves_where_its_scales_say) {
  const Colour red{0.8, 0, 0};
  const Colour blue{0, 0, 0.8};
  const Colour yellow{0.9, 0.9, 0};
  PictureOptions options;
  options.format = PictureFormat::png;
  options.width = 400;
  options.height = 300;
  const auto line = [](double x) { return 50 - x / 2; };
  const Pixels pixels = decode(written([&](OutputFile& file) {
    Canvas canvas(options, file);
    canvas.fill({0, 0, 400, 300}, {1, 1, 1});
    Chart chart(canvas, {50, 40, 300, 200}, {.title = "x", .end = 100}, {.title = "y", .end = 50});
    chart.draw_grid();
    chart.fill_between([](double) { return 0.0; }, line, 50, yellow);
    chart.curve(line, {.colour = red, .width = 3});
    chart.curve([](double) { return 80.0; }, {.colour = blue, .width = 3}, 20);  // beyond the frame
    return canvas.finish();
  }));
  for (const double x : {30.0, 50.0, 90.0}) EXPECT_TRUE(pixels.has({50 + 3 * x, 240 - 4 * line(x)}, red)) << x;
  EXPECT_TRUE(pixels.has({50 + 3 * 40, 230}, yellow));
  EXPECT_FALSE(pixels.has({50 + 3 * 55, 230}, yellow));
  EXPECT_TRUE(pixels.has({80, 40}, blue));  // held at the edge
  EXPECT_FALSE(pixels.has({150, 40}, blue));
}

TEST_F(MotorPicture, the_end_of_an_axis_is_round_and_not_below_what_it_must_hold) {
  EXPECT_EQ(axis_end(480), 500);
  EXPECT_EQ(axis_end(500), 500);
  EXPECT_EQ(axis_end(1040), 1200);
  EXPECT_DOUBLE_EQ(axis_end(0.33), 0.35);
  EXPECT_EQ(axis_end(0), 1);
  for (double least = 1e-6; least < 1e6; least *= 1.37) {
    EXPECT_GE(axis_end(least), least * (1 - 1e-9));
    EXPECT_LE(axis_end(least), 1.3 * least);
  }
}

TEST_F(MotorPicture, shows_the_friction_and_the_two_rates_where_there_are_any) {
  const TorqueCurve falling = curve({{Hertz(0), {0.4}}, {Hertz(2000), {0}}});
  const std::string bare = draw({.curve = falling, .end = Hertz(2000)}, PictureFormat::svg);
  const std::string loaded =
      draw({.curve = falling, .load = {.friction = {0.1}}, .end = Hertz(2000)}, PictureFormat::svg);
  // Without load, the dashed lines are the guides of both rates in each chart. With friction, the line of the friction
  // and its line in the legend are added.
  EXPECT_EQ(count(bare, "dasharray"), 4U);
  EXPECT_EQ(count(loaded, "dasharray"), 6U);
}

TEST_F(MotorPicture, of_any_motor_is_a_picture) {
  const TorqueCurve falling = curve({{Hertz(0), {0.4}}, {Hertz(2000), {0.2}}});
  const TorqueCurve tiny = curve({{Hertz(0), {1e-7}}, {Hertz(0.5), {0}}});
  const TorqueCurve endless = *TorqueCurve::from_motor({.rotor = {.steps_per_revolution = 200, .inertia = {6.8e-6}},
                                                        .holding_torque = {0.1},
                                                        .rated_current = {1.7},
                                                        .resistance = {1.5},
                                                        .inductance = {2.8e-3}},
                                                       {.supply = {24}});
  for (const MotorScene& scene :
       {MotorScene{.curve = falling, .load = {.friction = {2}}, .end = Hertz(3000)},
        MotorScene{.curve = falling, .load = {.inertia = {1}}, .end = Hertz(100)},
        MotorScene{.curve = tiny, .end = Hertz(1)}, MotorScene{.curve = endless, .end = Hertz(1e7)}}) {
    EXPECT_EQ(decode(draw(scene, PictureFormat::png)).width, 1600U);
    const std::string svg = draw(scene, PictureFormat::svg);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
  }
}

}  // namespace
}  // namespace passo
