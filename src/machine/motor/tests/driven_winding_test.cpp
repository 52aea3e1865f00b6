#include "passo/motor/driven_winding.hpp"

#include <numbers>
#include <random>

#include "example_motors.hpp"
#include "kit/seed.hpp"

namespace passo {
namespace {

using std::numbers::sqrt2;

double pull_out(const MotorData& motor, const MotorDrive& drive, double speed) {
  return DrivenWinding(motor, drive).pull_out({speed}).value;
}

// Speeds at which a random motor is tested: from crawling to far beyond the speed that uses up the voltage.
std::vector<double> speeds_of(const MotorData& motor, const MotorDrive& drive) {
  const double corner = drive.supply.value / (motor.rated_current.value * motor.inductance.value * motor.rotor.teeth());
  std::vector<double> speeds;
  for (double share = 0.01; share < 20; share *= 1.4) speeds.push_back(corner * share);
  return speeds;
}

template <class Look>
void for_random_motors(int count, const Look& look) {
  const std::uint64_t seed = test::seed();
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  for (int i = 0; i < count; ++i) {
    const test::Driven driven = test::random_motor(random);
    look(driven.motor, driven.drive);
  }
}

TEST(DrivenWinding, at_rest_gives_the_holding_torque_over_the_root_of_two_whatever_drives_it) {
  for_random_motors(200, [](const MotorData& motor, MotorDrive drive) {
    for (const Regulation regulation : {Regulation::chopper, Regulation::resistive}) {
      drive.regulation = regulation;
      EXPECT_NEAR(pull_out(motor, drive, 0), motor.holding_torque.value / sqrt2, 1e-12);
    }
  });
}

TEST(DrivenWinding, a_supply_below_what_the_rated_current_needs_holds_as_much_less) {
  const MotorData motor = test::small_motor();  // 1.7 A through 1.5 Ω: 2.55 V
  for (const Regulation regulation : {Regulation::chopper, Regulation::resistive}) {
    EXPECT_NEAR(pull_out(motor, {.supply = {2.55 / 3}, .regulation = regulation}, 0), 0.45 / sqrt2 / 3, 1e-12);
  }
}

TEST(DrivenWinding, torque_falls_with_the_speed_and_is_never_negative) {
  for_random_motors(300, [](const MotorData& motor, MotorDrive drive) {
    for (const Regulation regulation : {Regulation::chopper, Regulation::resistive}) {
      drive.regulation = regulation;
      double last = pull_out(motor, drive, 0);
      for (const double speed : speeds_of(motor, drive)) {
        const double torque = pull_out(motor, drive, speed);
        ASSERT_LE(torque, last * (1 + 1e-12));
        ASSERT_GE(torque, 0);
        last = torque;
      }
    }
  });
}

TEST(DrivenWinding, more_voltage_never_lowers_the_torque) {
  for_random_motors(300, [](const MotorData& motor, MotorDrive drive) {
    for (const Regulation regulation : {Regulation::chopper, Regulation::resistive}) {
      drive.regulation = regulation;
      MotorDrive stronger = drive;
      stronger.supply.value *= 1.3;
      for (const double speed : speeds_of(motor, drive)) {
        ASSERT_GE(pull_out(motor, stronger, speed), pull_out(motor, drive, speed) - 1e-12);
      }
    }
  });
}

TEST(DrivenWinding, a_chopper_is_at_no_speed_weaker_than_a_resistor_on_the_same_supply) {
  for_random_motors(300, [](const MotorData& motor, MotorDrive drive) {
    for (const double speed : speeds_of(motor, drive)) {
      MotorDrive resistive = drive;
      resistive.regulation = Regulation::resistive;
      ASSERT_GE(pull_out(motor, drive, speed), pull_out(motor, resistive, speed) - 1e-12);
    }
  });
}

TEST(DrivenWinding, without_inductance_a_chopper_holds_full_torque_until_back_emf_and_resistance_use_up_the_supply) {
  MotorData motor = test::small_motor();
  motor.inductance = {1e-12};
  const double constant = 0.45 / (sqrt2 * 1.7);
  const double corner = (24 - 1.7 * 1.5) / constant;
  const double end = 24 / constant;
  for (const double share : {0.1, 0.5, 0.9, 0.999}) {
    EXPECT_NEAR(pull_out(motor, {.supply = {24}}, share * corner), 0.45 / sqrt2, 1e-9);
  }
  // From there on the rest of the supply drives the current through the resistance.
  for (const double speed : {corner + 1, (corner + end) / 2, end - 1}) {
    EXPECT_NEAR(pull_out(motor, {.supply = {24}}, speed), constant * (24 - constant * speed) / 1.5, 1e-6);
  }
  EXPECT_EQ(pull_out(motor, {.supply = {24}}, end + 0.01), 0);
}

TEST(DrivenWinding, without_inductance_a_resistive_drive_has_the_straight_line_of_a_dc_motor) {
  MotorData motor = test::small_motor();
  motor.inductance = {1e-12};
  const double constant = 0.45 / (sqrt2 * 1.7);
  for (const double share : {0.0, 0.25, 0.5, 0.99}) {
    EXPECT_NEAR(pull_out(motor, {.supply = {24}, .regulation = Regulation::resistive}, share * 24 / constant),
                0.45 / sqrt2 * (1 - share), 1e-9);
  }
}

// At last R and the back-EMF are small beside X. The torque is then K·V/X, so speed times torque is constant.
TEST(DrivenWinding, far_beyond_the_corner_a_weak_magnet_gives_constant_power) {
  MotorData motor = test::small_motor();
  motor.resistance = {1e-9};
  motor.holding_torque = {0.045};
  const double power = pull_out(motor, {.supply = {24}}, 400) * 400;
  EXPECT_NEAR(pull_out(motor, {.supply = {24}}, 4000) * 4000, power, 1e-4 * power);
  EXPECT_NEAR(power, 0.045 / (sqrt2 * 1.7) * 24 / (50 * 2.8e-3), 1e-4 * power);
}

TEST(DrivenWinding, a_half_coil_is_a_quarter_of_the_inductance_at_the_same_heat) {
  const MotorData whole = test::small_motor();
  const MotorData half = as_wound(whole, Winding::half_coil);
  EXPECT_DOUBLE_EQ(half.resistance.value, 1.5 / 2);
  EXPECT_DOUBLE_EQ(half.inductance.value, 2.8e-3 / 4);
  EXPECT_DOUBLE_EQ(half.rated_current.value, 1.7 * sqrt2);
  EXPECT_DOUBLE_EQ(half.holding_torque.value, 0.45 / sqrt2);
  const auto heat = [](const MotorData& motor) {
    return motor.rated_current.value * motor.rated_current.value * motor.resistance.value;
  };
  EXPECT_DOUBLE_EQ(heat(half), heat(whole));
  const MotorData back = as_wound(half, Winding::whole_coil);
  EXPECT_DOUBLE_EQ(back.inductance.value, whole.inductance.value);
  EXPECT_DOUBLE_EQ(back.holding_torque.value, whole.holding_torque.value);
  EXPECT_EQ(as_wound(whole, Winding::whole_coil).resistance, whole.resistance);
}

// The reason for unipolar drives: weaker at rest, stronger where the voltage is short.
TEST(DrivenWinding, the_same_motor_driven_unipolar_is_weaker_when_slow_and_stronger_when_fast) {
  const MotorDrive bipolar{.supply = {12}};
  const MotorDrive unipolar{.supply = {12}, .winding = Winding::half_coil};
  const MotorData motor = test::small_motor();
  EXPECT_NEAR(pull_out(motor, unipolar, 0) / pull_out(motor, bipolar, 0), 1 / sqrt2, 1e-12);
  EXPECT_GT(pull_out(motor, unipolar, 100), pull_out(motor, bipolar, 100));
}

TEST(DrivenWinding, half_coil_data_on_a_unipolar_drive_are_taken_as_they_are) {
  MotorData motor = test::small_motor();
  const double bipolar = pull_out(motor, {.supply = {24}}, 60);
  motor.winding = Winding::half_coil;
  EXPECT_DOUBLE_EQ(pull_out(motor, {.supply = {24}, .winding = Winding::half_coil}, 60), bipolar);
}

TEST(MotorData, is_refused_with_the_value_that_is_wrong) {
  const auto message = [](const auto& change) {
    MotorData motor = test::small_motor();
    change(motor);
    const auto good = check(motor);
    return good ? std::string("accepted") : good.error().message;
  };
  EXPECT_EQ(message([](MotorData&) {}), "accepted");
  EXPECT_EQ(message([](MotorData& m) { m.rotor.steps_per_revolution = 201; }),
            "the full steps per revolution of a two-phase motor must be a multiple of 4, not 201");
  EXPECT_EQ(message([](MotorData& m) { m.rotor.steps_per_revolution = 0; }),
            "the full steps per revolution of a two-phase motor must be a multiple of 4, not 0");
  EXPECT_EQ(message([](MotorData& m) { m.rotor.inertia = {0}; }),
            "the rotor's inertia must be above 0 kg\u00B7m\u00B2, not 0");
  EXPECT_EQ(message([](MotorData& m) { m.holding_torque = {-1}; }),
            "the holding torque must be above 0 N\u00B7m, not -1");
  EXPECT_EQ(message([](MotorData& m) { m.rated_current = {std::nan("")}; }),
            "the rated current must be above 0 A, not nan");
  EXPECT_EQ(message([](MotorData& m) { m.resistance = {0}; }), "the resistance must be above 0 ohm, not 0");
  EXPECT_EQ(message([](MotorData& m) { m.inductance = {1 / 0.0}; }), "the inductance must be above 0 H, not inf");
  EXPECT_EQ(check(MotorDrive{.supply = {0}}).error().message, "the supply voltage must be above 0 V, not 0");
}

}  // namespace
}  // namespace passo
