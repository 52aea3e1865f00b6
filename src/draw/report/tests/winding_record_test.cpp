#include "passo/report/winding_record.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>

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
