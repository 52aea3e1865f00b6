#include "passo/geometry/cutter.hpp"

#include <cmath>
#include <string>

#include <gmock/gmock.h>

namespace passo {
namespace {

using testing::HasSubstr;

Cutter cutter_of(const char* text) {
  const Result<Cutter, std::string> cutter = parse_cutter(text);
  EXPECT_TRUE(cutter) << text;
  return cutter ? *cutter : Cutter{};
}

TEST(Cutter, has_the_height_of_its_shape) {
  EXPECT_NEAR(cutter_of("ball:3").height(Mm(1.2)).value(), 1.5 - std::sqrt(1.5 * 1.5 - 1.2 * 1.2), 1e-12);
  EXPECT_EQ(cutter_of("flat:6").height(Mm(2.9)).value(), 0);
  EXPECT_EQ(cutter_of("bull:6:1").height(Mm(2)).value(), 0);
  EXPECT_NEAR(cutter_of("bull:6:1").height(Mm(3)).value(), 1, 1e-12);
  EXPECT_NEAR(cutter_of("vee:60:6").height(Mm(2)).value(), 2 * std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(cutter_of("vee:90:6:1").height(Mm(2)).value(), 1.5, 1e-12);
  // The ball of 1 mm ends where its tangent is the cone's flank, which meets the axis below the tip.
  const double sine = std::sin(5 * M_PI / 180);
  const double below = 0.5 / sine - 0.5;
  EXPECT_NEAR(cutter_of("taper:1:5:6").height(Mm(2)).value(), 2 / std::tan(5 * M_PI / 180) - below, 1e-9);
}

TEST(Cutter, has_the_slope_of_its_height) {
  for (const char* text : {"ball:3", "flat:6", "bull:6:1", "vee:60:6", "vee:90:6:1", "taper:1:5:6"}) {
    const Cutter cutter = cutter_of(text);
    for (double at = 0.05; at < 0.98 * cutter.radius.value(); at += 0.0317) {
      const double expected = (cutter.height(Mm(at + 1e-6)) - cutter.height(Mm(at - 1e-6))).value() / 2e-6;
      if (expected > 19) continue;
      EXPECT_NEAR(cutter.slope(Mm(at)), expected, 1e-3) << text << " at " << at;
    }
  }
}

TEST(Cutter, grown_by_the_stock_is_the_shape_that_far_away) {
  const Cutter ball = cutter_of("ball:3").grown(Mm(0.5));
  EXPECT_NEAR(ball.height(Mm(1)).value(), 2 - std::sqrt(3.0), 1e-12);
  const Cutter flat = cutter_of("flat:6").grown(Mm(0.5));
  EXPECT_NEAR(flat.height(Mm(3)).value(), 0, 1e-12);
  EXPECT_NEAR(flat.height(Mm(3.5)).value(), 0.5, 1e-12);
  const Cutter vee = cutter_of("vee:90:6").grown(Mm(0.5));  // its flank is parallel, its tip 0.5 lower
  EXPECT_NEAR(vee.height(Mm(2)).value(), 2 - 0.5 * std::sqrt(2.0) + 0.5, 1e-12);
}

TEST(Cutter, keeps_ridges_as_low_as_wanted) {
  const double step = cutter_of("ball:3").step_for_scallop(Mm(0.02)).value();
  EXPECT_NEAR(1.5 - std::sqrt(1.5 * 1.5 - step * step / 4), 0.02, 1e-12);
  EXPECT_NEAR(cutter_of("vee:60:6").step_for_scallop(Mm(0.1)).value(), 0.2 * std::tan(M_PI / 6), 1e-12);
  EXPECT_NEAR(cutter_of("bull:6:1").step_for_scallop(Mm(0.02)).value(), 4 + 2 * std::sqrt(0.04 - 0.0004), 1e-12);
}

TEST(Cutter, knows_which_of_the_five_it_is) {
  for (const auto& [text, kind] : {std::pair("ball:3", Cutter::Kind::ball),
                                   {"flat:6", Cutter::Kind::flat},
                                   {"bull:6:1", Cutter::Kind::bull_nose},
                                   {"bull:6:3", Cutter::Kind::ball},
                                   {"bull:6:0", Cutter::Kind::flat},
                                   {"vee:60:6", Cutter::Kind::v},
                                   {"vee:90:6:1", Cutter::Kind::v},
                                   {"taper:1:5:6", Cutter::Kind::tapered_ball}}) {
    EXPECT_EQ(cutter_of(text).kind(), kind) << text;
    EXPECT_EQ(cutter_kind_of(name_of(kind)), kind) << text;
  }
  EXPECT_EQ(cutter_kind_of("drill"), std::nullopt);
}

// The corner's end may round to a hair inside of the radius: beyond the end there is a cone only if there is an angle.
TEST(Cutter, is_finite_up_to_its_radius) {
  for (double corner = 0.013; corner < 1.4; corner += 0.0171) {
    const Cutter bull = Cutter::bull_nose(Mm(3), Mm(corner)).grown(Mm(0.1));
    EXPECT_LE(bull.height(bull.radius).value(), corner + 0.1 + 1e-9) << corner;
    EXPECT_LE(bull.slope(bull.radius), 20.001) << corner;
  }
}

TEST(Cutter, that_is_none_is_refused_with_what_was_expected) {
  for (const char* text :
       {"", "ball", "ball:", "ball:0", "ball:-1", "ball:nan", "ball:3:1", "flat:600", "vee:60:6:6", "bull:6:4",
        "vee:60", "vee:0:6", "vee:180:6", "vee:60:6:7", "taper:7:5:6", "taper:1:90:6", "drill:3"}) {
    const Result<Cutter, std::string> cutter = parse_cutter(text);
    ASSERT_FALSE(cutter) << text;
    EXPECT_THAT(cutter.error(), HasSubstr("expected")) << text;
  }
}

TEST(Cutter, is_told_in_words) {
  EXPECT_EQ(describe(cutter_of("ball:3")), "ball nose, 3 mm");
  EXPECT_EQ(describe(cutter_of("flat:6")), "flat end, 6 mm");
  EXPECT_EQ(describe(cutter_of("bull:6:1")), "bull nose, 6 mm, corner 1 mm");
  EXPECT_EQ(describe(cutter_of("vee:60:6:0.2")), "V of 60 degrees, 6 mm, tip 0.2 mm");
  EXPECT_EQ(describe(cutter_of("taper:1:5:6")), "tapered ball, 1 mm at the tip, 5 degrees per side, 6 mm");
}

}  // namespace
}  // namespace passo
