// `passo motor` as a user starts it.
#include <cmath>
#include <cstdio>
#include <numbers>
#include <sstream>

#include "kit/command_line.hpp"
#include <nlohmann/json.hpp>

namespace {

namespace fs = std::filesystem;
using passo::test::Outcome;
using passo::test::read;
using std::numbers::pi;

struct Row {
  double rate = 0;
  double speed = 0;
  double pull_out = 0;
  double pull_in = 0;
  double acceleration = 0;
};

const std::string small_motor =
    "--holding-torque 0.45 --current 1.7 --resistance 1.5 --inductance 2.8 --rotor-inertia 68 ";
const std::string measured = "--curve 0:0.40,1000:0.36,2000:0.25,4000:0.10 --rotor-inertia 68 ";

class MotorCommand : public passo::test::CommandLine {
 protected:
  Outcome motor(const std::string& arguments) const { return passo("motor " + arguments); }
  std::vector<Row> table(const std::string& arguments) const {
    const Outcome outcome = motor(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    std::istringstream lines(outcome.out);
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "rate_hz,speed_rad_s,pull_out_nm,pull_in_nm,acceleration_rad_s2");
    std::vector<Row> rows;
    while (std::getline(lines, line)) {
      Row row;
      EXPECT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf", &row.rate, &row.speed, &row.pull_out, &row.pull_in,
                            &row.acceleration),
                5)
          << line;
      rows.push_back(row);
    }
    return rows;
  }
  nlohmann::json summary(const std::string& arguments) const {
    const Outcome outcome = motor(arguments + " --json");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out);
  }
};

TEST_F(MotorCommand, help_teaches_with_examples_that_run) {
  const Outcome help = motor("--help");
  EXPECT_EQ(help.code, 0);
  // Every example, its continuation lines joined, its picture put aside.
  std::string text = help.out;
  for (std::size_t i; (i = text.find("\\\n")) != std::string::npos;) text.erase(i, 2);
  std::istringstream lines(text);
  int examples = 0;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = line.find("passo motor --");
    if (begin == std::string::npos) continue;
    std::string arguments = line.substr(begin + 12);
    if (const std::size_t picture = arguments.find("motor.svg"); picture != std::string::npos) {
      arguments.replace(picture, 9, path("motor.svg"));
    }
    const Outcome outcome = motor(arguments);
    EXPECT_EQ(outcome.code, 0) << line << outcome.err;
    ++examples;
  }
  EXPECT_EQ(examples, 3);
}

TEST_F(MotorCommand, the_table_is_that_of_the_motor_in_full_steps) {
  const auto rows = table(small_motor + "--supply 24 --load-inertia 32 --friction 0.05 --max-rate 4000 --rows 5");
  ASSERT_EQ(rows.size(), 5U);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_DOUBLE_EQ(rows[i].rate, 1000.0 * static_cast<double>(i));
    EXPECT_NEAR(rows[i].speed, rows[i].rate * pi / 100, 1e-6);
    EXPECT_NEAR(rows[i].acceleration, (rows[i].pull_out - 0.05) / 100e-7, 1e-3);
    EXPECT_LE(rows[i].pull_in, rows[i].pull_out);
  }
  EXPECT_NEAR(rows[0].pull_out, 0.45 / std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(rows[2].pull_out, 0.45 / std::sqrt(2.0), 1e-9);  // the voltage suffices still
  EXPECT_LT(rows[4].pull_out, 0.25);
}

TEST_F(MotorCommand, measured_points_are_in_the_table_as_given) {
  const auto rows = table(measured + "--max-rate 5000 --rows 6 --steps-per-rev 400");
  EXPECT_DOUBLE_EQ(rows.at(1).pull_out, 0.36);
  EXPECT_DOUBLE_EQ(rows.at(2).pull_out, 0.25);
  EXPECT_DOUBLE_EQ(rows.at(4).pull_out, 0.10);
  EXPECT_EQ(rows.at(5).pull_out, 0);
  EXPECT_EQ(rows.at(5).acceleration, 0);
  EXPECT_NEAR(rows.at(2).speed, 10 * pi, 1e-6);
}

TEST_F(MotorCommand, the_summary_tells_the_two_rates) {
  const auto json = summary("--curve 0:0.4,2000:0 --pull-in 0:0.3,1000:0 --rotor-inertia 50 --friction 0.1");
  EXPECT_NEAR(json["fastest_rate_hz"], 1500, 1e-6);
  EXPECT_NEAR(json["fastest_speed_rad_s"], 15 * pi, 1e-6);
  EXPECT_NEAR(json["maximum_starting_rate_hz"], 2000.0 / 3, 1e-6);
  EXPECT_NEAR(json["maximum_starting_rate_without_load_hz"], 1000, 1e-6);
  EXPECT_NEAR(json["acceleration_at_rest_rad_s2"], 0.3 / 50e-7, 1e-3);
  EXPECT_EQ(json["standstill_torque_nm"], 0.4);
}

TEST_F(MotorCommand, a_rate_without_end_is_null) {
  EXPECT_TRUE(summary(small_motor + "--supply 24")["fastest_rate_hz"].is_null());
  EXPECT_TRUE(summary(small_motor + "--supply 24 --friction 0.05")["fastest_rate_hz"].is_number());
}

TEST_F(MotorCommand, drive_and_data_are_what_they_say) {
  const auto rate = [&](const std::string& options) {
    return summary(small_motor + "--friction 0.1 --supply 12 " + options)["fastest_rate_hz"].get<double>();
  };
  EXPECT_GT(rate(""), rate("--regulation resistive"));
  EXPECT_DOUBLE_EQ(rate("--drive unipolar"), rate(""));  // data of that connection
  EXPECT_GT(rate("--drive unipolar --data bipolar"), rate(""));
  EXPECT_LT(rate("--data unipolar"), rate(""));
}

TEST_F(MotorCommand, margin_and_viscous_friction_lower_the_acceleration) {
  const std::string some = measured + "--max-rate 2000 --rows 3 ";
  EXPECT_NEAR(table(some + "--margin 0.5")[1].acceleration, table(some)[1].acceleration / 2, 1e-3);
  EXPECT_NEAR(table(some)[1].acceleration - table(some + "--viscous-friction 0.001")[1].acceleration,
              0.001 * 10 * pi / 68e-7, 1e-2);
}

TEST_F(MotorCommand, pictures_are_written_and_the_table_is_not) {
  const Outcome outcome = motor(small_motor + "--supply 24 --picture " + path("m.svg") + " -p " + path("m.png"));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(read(path("m.svg")).find("<svg"), std::string::npos);
  EXPECT_EQ(read(path("m.png")).substr(1, 3), "PNG");
  const Outcome nowhere = motor(measured + "-p /nonexistent/m.svg");
  EXPECT_EQ(nowhere.code, 1);
  EXPECT_NE(nowhere.err.find("/nonexistent/m.svg"), std::string::npos);
}

struct Wrong {
  const char* name;
  std::string arguments;
  const char* words;
};

void PrintTo(const Wrong& wrong, std::ostream* out) {
  *out << wrong.name;
}

class WrongMotors : public MotorCommand, public testing::WithParamInterface<Wrong> {};

TEST_P(WrongMotors, are_refused_with_what_was_expected) {
  const Outcome outcome = motor(GetParam().arguments);
  EXPECT_EQ(outcome.code, 2) << outcome.err;
  EXPECT_NE(outcome.err.find(GetParam().words), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.out, "");
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongMotors,
    testing::Values(
        Wrong{"no_inertia", "--curve 0:1,10:0", "--rotor-inertia is required"},
        Wrong{"no_motor", "--rotor-inertia 68 --current 2 --supply 24",
              "expected --curve, or also --holding-torque, --resistance, --inductance"},
        Wrong{"both", measured + "--current 2", "--current and --curve set the same"},
        Wrong{"no_point", "--curve 0:0.4,1000 --rotor-inertia 68", "'1000' is not a point; expected RATE:TORQUE"},
        Wrong{"no_number", "--curve 0:0.4,1000:x --rotor-inertia 68", "'1000:x' is not a point"},
        Wrong{"trailing", "--curve 0:0.4,1000:0.2N --rotor-inertia 68", "'1000:0.2N' is not a point"},
        Wrong{"rising", "--curve 0:0.4,1000:0.5 --rotor-inertia 68", "rises to 0.5 N\u00B7m at 1000 steps/s"},
        Wrong{"descending", "--curve 1000:0.4,500:0.3 --rotor-inertia 68", "must be in ascending order"},
        Wrong{"one_point", "--curve 1000:0.4 --rotor-inertia 68", "at least 2 points"},
        Wrong{"pull_in_above", measured + "--pull-in 0:0.5,10:0", "pull-in torque cannot be above pull-out torque"},
        Wrong{"pull_in_alone", small_motor + "--supply 24 --pull-in 0:0.5,10:0", "--pull-in needs"},
        Wrong{"odd_steps", measured + "--steps-per-rev 150", "must be a multiple of 4, not 150"},
        Wrong{"negative_voltage", small_motor + "--supply -24", "the supply voltage must be above 0 V, not -24"},
        Wrong{"zero_inertia", "--curve 0:1,10:0 --rotor-inertia 0", "rotor's inertia must be above 0"},
        Wrong{"not_a_number", small_motor + "--supply nan", "must be above 0 V, not nan"},
        Wrong{"negative_friction", measured + "--friction -1", "friction must be 0"},
        Wrong{"margin", measured + "--margin 1.5", "--margin must be between 0 and 1"},
        Wrong{"rate", measured + "--max-rate 0", "--max-rate must be above 0"},
        Wrong{"rows", measured + "--rows 1", "--rows must be between 2"},
        Wrong{"drive", measured + "--drive tripolar", "tripolar not in {bipolar,unipolar}"},
        Wrong{"picture", measured + "-p m.jpeg", "the name of a picture must end with .svg or .png"}),
    [](const testing::TestParamInfo<Wrong>& param_info) { return param_info.param.name; });

}  // namespace
