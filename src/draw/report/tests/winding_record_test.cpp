#include "passo/report/winding_record.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "kit/golden.hpp"
#include <gtest/gtest.h>
#include <unistd.h>

namespace passo {
namespace {

namespace fs = std::filesystem;

class WindingRecords : public testing::Test {
 protected:
  ~WindingRecords() override { fs::remove(path_); }

  template <class Write>
  std::string written(const Write& write) const {
    auto file = OutputFile::open(path_.string());
    EXPECT_TRUE(file);
    write(*file);
    EXPECT_TRUE(file->commit());
    std::ifstream stream(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  fs::path path_ = fs::temp_directory_path() / ("passo-windings-" + std::to_string(::getpid()));
};

WindingMotors two_motors() {
  return {.excitation = *Excitation::named("half-step"), .full_steps_per_turn = 48, .count = 2};
}

// X up three times, Y down once together with the second; then a pulse that moves nothing.
std::vector<TimedPulse> pulses() {
  return {{Seconds(0.001), {0b01, 0}},
          {Seconds(0.0025), {0b11, 0b10}},
          {Seconds(0.004), {0b01, 0}},
          {Seconds(0.0045), {0, 0}}};
}

TEST_F(WindingRecords, of_a_short_move_are_what_they_were) {
  for (const char* form : {"csv", "vcd"}) {
    const std::string text = written([&](OutputFile& file) {
      const auto play = [&](WindingRecord&& record) {
        for (const TimedPulse& pulse : pulses()) record.add(pulse);
        record.finish(Seconds(0.005));
      };
      if (form == std::string("csv")) play(WindingCsv(two_motors(), file));
      if (form == std::string("vcd")) play(WindingVcd(two_motors(), file));
    });
    test::expect_golden(std::string("src/draw/report/tests/golden/windings.") + form, text);
  }
}

// With 1 A, 12.8 Ω and 10 mH on 13.8 V less a volt the current of F2 rises by 1 − e^(−t/τ) while that of F1 falls.
TEST_F(WindingRecords, have_currents_that_rise_where_the_motor_is_known) {
  const std::string text = written([&](OutputFile& file) {
    WindingMotors one{.excitation = *Excitation::named("wave"), .full_steps_per_turn = 200};
    one.stage = WindingStage{.circuit = {.supply = {13.8}, .drop = {1}, .winding = {12.8}, .inductance = {10e-3}},
                             .rated = {1}};
    WindingCsv record(one, file);
    record.add({Seconds(0.001), {1, 0}});
    record.finish(Seconds(0.001));
  });
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "t,x,x_f1,x_f2,x_f3,x_f4,x_a,x_b,x_deg");
  int rows = 0;
  double t = 0;
  for (; std::getline(lines, line); ++rows) {
    double a = 0;
    double b = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%*d,%*d,%*d,%*d,%*d,%lf,%lf", &t, &a, &b), 3) << line;
    const double e = t <= 0.001 ? 1 : std::exp(-(t - 0.001) * 12.8 / 10e-3);
    EXPECT_NEAR(a, e, 1e-6) << line;
    EXPECT_NEAR(b, 1 - e, 1e-6) << line;
  }
  EXPECT_GT(rows, 40);
  EXPECT_GT(t, 0.005) << "until the current has settled";
}

TEST_F(WindingRecords, are_drawn_with_a_column_for_each_motor) {
  const auto svg = [&](std::size_t motors) {
    WindingScene scene{.motors = two_motors(), .pulses = pulses(), .end = Seconds(0.005)};
    scene.motors.count = motors;
    if (motors == 1) {
      for (TimedPulse& pulse : scene.pulses) pulse.pulse.steps &= 1;
    }
    return written([&](OutputFile& file) {
      const PictureOptions options{.format = PictureFormat::svg, .program = "Windings", .machine = ""};
      EXPECT_TRUE(draw_windings(scene, options, file));
    });
  };
  EXPECT_GT(svg(2).size(), svg(1).size() + 2000);
  WindingScene still{.motors = two_motors(), .pulses = {}, .end = Seconds(0)};
  EXPECT_NE(written([&](OutputFile& file) {
              EXPECT_TRUE(draw_windings(still, {.format = PictureFormat::svg, .program = "", .machine = ""}, file));
            }).find("</svg>"),
            std::string::npos);
}

}  // namespace
}  // namespace passo
