#include "passo/report/picture.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <random>
#include <set>

#include "motion.hpp"
#include "path_colours.hpp"
#include "picture_views.hpp"
#include "speed_colours.hpp"
#include <png.h>

namespace passo {
namespace {

namespace fs = std::filesystem;

class Picture : public testing::Test {
 protected:
  ~Picture() override { fs::remove(path_); }

  std::string draw(const PathRecorder& path, PictureOptions options) {
    auto file = OutputFile::open(path_.string());
    EXPECT_TRUE(file) << file.error().message;
    const auto drawn = draw_picture(path, options, *file);
    EXPECT_TRUE(drawn) << drawn.error().message;
    EXPECT_TRUE(file->commit());
    std::ifstream stream(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  static PictureOptions options(PictureFormat format) {
    PictureOptions options;
    options.format = format;
    options.program = "part.ngc";
    options.machine = "Test bench";
    return options;
  }

  fs::path path_ = fs::temp_directory_path() / ("passo-picture-" + std::to_string(::getpid()));
};

struct Image {
  unsigned width = 0;
  unsigned height = 0;
  std::vector<png_byte> bytes;  // red, green, blue

  std::set<unsigned> colours() const {
    std::set<unsigned> all;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
      all.insert(unsigned{bytes[i]} << 16U | unsigned{bytes[i + 1]} << 8U | bytes[i + 2]);
    }
    return all;
  }
};

Image decode(const std::string& bytes) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()), 0) << png.message;
  png.format = PNG_FORMAT_RGB;
  Image image{png.width, png.height, std::vector<png_byte>(PNG_IMAGE_SIZE(png))};
  EXPECT_NE(png_image_finish_read(&png, nullptr, image.bytes.data(), 0, nullptr), 0) << png.message;
  return image;
}

// Whether every element is closed in order and every attribute is quoted. An SVG uses no other feature of XML.
bool well_formed(const std::string& xml) {
  std::vector<std::string> open;
  for (std::size_t i = xml.find('<'); i != std::string::npos; i = xml.find('<', i)) {
    const std::size_t end = xml.find('>', i);
    if (end == std::string::npos) return false;
    const std::string tag = xml.substr(i + 1, end - i - 1);
    i = end;
    if (tag.front() == '?' || tag.front() == '!') continue;
    if (std::ranges::count(tag, '"') % 2 != 0) return false;
    if (tag.front() == '/') {
      if (open.empty() || open.back() != tag.substr(1)) return false;
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(tag.substr(0, tag.find_first_of(" \n")));
    }
  }
  return open.empty() && xml.find("<svg") != std::string::npos;
}

PathRecorder small_path() {
  PathRecorder path;
  path.watch(rapid(at(0, 0, 5), at(10, 20, 5)), at(5, 5));
  path.watch(feed(at(10, 20, 5), at(10, 20, -1)), at(5, 5));
  path.watch(play(Curve::arc(at(10, 20, -1), at(30, 20, -1), Axis::x, Axis::y, 20, 20, -std::numbers::pi), 10, 20),
             at(5, 5));
  return path;
}

TEST_F(Picture, a_png_has_the_size_asked_for_and_shows_something) {
  const Image image = decode(draw(small_path(), options(PictureFormat::png)));
  EXPECT_EQ(image.width, 1600U);
  EXPECT_EQ(image.height, 900U);
  EXPECT_GT(image.colours().size(), 100U);

  PictureOptions large = options(PictureFormat::png);
  large.width = 800;
  large.height = 450;
  large.pixels_per_unit = 3;
  EXPECT_EQ(decode(draw(small_path(), large)).width, 2400U);
}

TEST_F(Picture, an_svg_is_well_formed_and_the_same_each_time) {
  const std::string first = draw(small_path(), options(PictureFormat::svg));
  const std::string second = draw(small_path(), options(PictureFormat::svg));
  EXPECT_TRUE(well_formed(first));
  EXPECT_NE(first.find("width=\"1600px\""), std::string::npos);
  EXPECT_TRUE(first == second);
}

TEST_F(Picture, shows_each_feed_in_the_colour_of_its_speed) {
  const auto pixels_of = [](const Image& image, const Colour& colour) {
    const auto near = [](png_byte byte, double part) { return std::abs(byte - 255 * part) < 1.5; };
    int count = 0;
    for (std::size_t i = 0; i < image.bytes.size(); i += 3) {
      if (near(image.bytes[i], colour.red) && near(image.bytes[i + 1], colour.green) &&
          near(image.bytes[i + 2], colour.blue)) {
        ++count;
      }
    }
    return count;
  };
  const SpeedColours colours(MmPerSecond(20));
  const Colour slow = SpeedColours::of_class(colours.class_of(5));
  PathRecorder path;
  path.watch(cruise(at(0, 0), at(50, 0), 20), Point());
  path.watch(cruise(at(50, 0), at(50, 50), 20), Point());
  // The legend shows every speed.
  const int legend = pixels_of(decode(draw(path, options(PictureFormat::png))), slow);
  path.watch(cruise(at(50, 50), at(0, 50), 5), Point());
  EXPECT_GT(pixels_of(decode(draw(path, options(PictureFormat::png))), slow), legend + 300);
}

TEST_F(Picture, rapids_are_dashed) {
  const auto dashes = [](const std::string& svg) {
    int count = 0;
    for (std::size_t i = svg.find("dasharray"); i != std::string::npos; i = svg.find("dasharray", i + 1)) ++count;
    return count;
  };
  PathRecorder feeds;
  feeds.watch(feed(at(0, 0), at(50, 0)), Point());
  EXPECT_EQ(dashes(draw(feeds, options(PictureFormat::svg))), 1);  // the legend
  EXPECT_EQ(dashes(draw(small_path(), options(PictureFormat::svg))), 3);
}

TEST_F(Picture, without_rapids_shows_and_measures_the_feeds_alone) {
  PictureOptions feeds_alone = options(PictureFormat::svg);
  feeds_alone.rapids = false;
  EXPECT_EQ(draw(small_path(), feeds_alone).find("dasharray"), std::string::npos);
  PathRecorder path = small_path();
  path.watch(rapid(at(30, 20), at(900, 900)), Point());
  EXPECT_EQ(path.extents().high[Axis::x], 900);
  EXPECT_EQ(path.feed_extents().high[Axis::x], 30);
}

TEST_F(Picture, gives_each_tool_a_colour) {
  PathRecorder path;
  path.watch(cruise(at(0, 0), at(50, 0), 20), Point());
  path.watch(Action{.kind = Action::Kind::tool_change, .tool = 7}, Point());
  path.watch(cruise(at(50, 0), at(50, 50), 20), Point());
  path.watch(Action{.kind = Action::Kind::tool_change, .tool = 0}, Point());
  path.watch(cruise(at(50, 50), at(0, 50), 20), Point());
  EXPECT_EQ(path.tools(), (std::vector<std::int32_t>{0, 7}));
  const PathColours colours(path, PathColour::tool);
  std::vector<std::size_t> classes;
  for (const PathRecorder::Vertex& vertex : path.vertices()) {
    if (vertex.kind == PathRecorder::Kind::feed) classes.push_back(colours.class_of(vertex, 0));
  }
  ASSERT_EQ(classes.size(), 3U);
  EXPECT_EQ(classes[0], classes[2]);
  EXPECT_NE(classes[0], classes[1]);
}

TEST_F(Picture, colours_a_slope_by_its_depth) {
  PathRecorder path;
  path.watch(cruise(at(0, 0, 0), at(50, 0, -10), 20), Point());
  const PathColours colours(path, PathColour::depth);
  const PathRecorder::Vertex& end = path.vertices().back();
  EXPECT_EQ(colours.class_of(end, -0.01), 0U);
  EXPECT_EQ(colours.class_of(end, -10), SpeedColours::classes - 1);
  EXPECT_EQ(colours.parts_between(0, -10), int{SpeedColours::classes});
  EXPECT_EQ(colours.parts_between(-5, -5), 1);
}

TEST_F(Picture, lies_where_the_work_lies) {
  const auto view = [](const Point& end, bool is_lathe = false) {
    PathRecorder path;
    path.watch(feed(at(1, 2, 3), end), Point());
    return natural_view(path, is_lathe);
  };
  EXPECT_EQ(view(at(5, 9, 3)), FlatView::top);
  EXPECT_EQ(view(at(5, 9, 9)), FlatView::top);
  EXPECT_EQ(view(at(5, 2, 9)), FlatView::front);
  EXPECT_EQ(view(at(5, 2, 9), true), FlatView::lathe);
  EXPECT_EQ(view(at(1, 9, 9)), FlatView::side);
  EXPECT_EQ(view(at(1, 2, 9)), FlatView::top);
  EXPECT_EQ(natural_view(PathRecorder(), false), FlatView::top);
}

TEST_F(Picture, of_a_degenerate_path_is_still_a_picture) {
  const auto line = [](const Point& from, const Point& to) {
    PathRecorder path;
    path.watch(feed(from, to), Point());
    return path;
  };
  for (const PathRecorder& path :
       {PathRecorder(), line(at(0, 0, 0), at(0, 0, -5)), line(at(0, 0, 0), at(1e-9, 0, 0)),
        line(at(1e6, 1e6, 0), at(1e6, 1e6 + 1e-6, 0)), line(at(-1e7, 0, 0), at(1e7, 1e7, 1e7)),
        line(at(0, 0, 0), at(300, 0, 0)), line(at(0, -300, 0), at(0, 300, 0))}) {
    EXPECT_TRUE(well_formed(draw(path, options(PictureFormat::svg))));
    const Image image = decode(draw(path, options(PictureFormat::png)));
    EXPECT_GT(image.colours().size(), 50U);
  }
}

TEST_F(Picture, any_bytes_may_stand_in_the_title) {
  PictureOptions strange = options(PictureFormat::svg);
  strange.program = "a<b>&\"\xff\xc3\x28\xe2\x82\x01.ngc";
  strange.machine = std::string(500, 'm');
  EXPECT_TRUE(well_formed(draw(small_path(), strange)));
}

TEST_F(Picture, an_svg_of_the_worst_path_stays_under_ten_megabytes) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> anywhere(-100, 100);
  std::uniform_real_distribution<double> speed(1, 50);
  PathRecorder path;
  Point last;
  for (int i = 0; i < 1'000'000; ++i) {
    const Point next = at(anywhere(random), anywhere(random), anywhere(random));
    path.watch(feed(last, next, speed(random), 1e6), Point());
    last = next;
  }
  const std::string svg = draw(path, options(PictureFormat::svg));
  EXPECT_LT(svg.size(), 10'000'000U);
  EXPECT_TRUE(well_formed(svg));
}

TEST_F(Picture, a_file_that_cannot_be_written_is_told_at_commit) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  for (const PictureFormat format : {PictureFormat::png, PictureFormat::svg}) {
    auto file = OutputFile::open("/dev/full");
    ASSERT_TRUE(file);
    EXPECT_TRUE(draw_picture(small_path(), options(format), *file));
    EXPECT_EQ(file->commit().error().message, "cannot write /dev/full: the disk is full");
  }
}

TEST(PictureFormat, is_told_by_the_end_of_the_name) {
  EXPECT_EQ(picture_format_of("out/part.svg"), PictureFormat::svg);
  EXPECT_EQ(picture_format_of("PART.PNG"), PictureFormat::png);
  EXPECT_EQ(picture_format_of("part.jpg"), std::nullopt);
  EXPECT_EQ(picture_format_of("svg"), std::nullopt);
}

}  // namespace
}  // namespace passo
