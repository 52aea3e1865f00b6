// passo motor: torque over speed, as a table, a picture or a summary.
#include <charconv>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <utility>

#include "argument_units.hpp"
#include "commands.hpp"
#include "motor_trial.hpp"
#include "named_files.hpp"
#include "picture_names.hpp"
#include "program_input.hpp"
#include "run_outputs.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/report/motor_picture.hpp"

namespace passo {
namespace {

constexpr double kg_m2_per_g_cm2 = 1e-7;

// Reads the whole text as a number, which need not be finite. Whether the value is sensible is checked later, where its
// meaning is known.
bool read_number(std::string_view text, double& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

Result<std::vector<TorquePoint>, MotorError> read_points(const char* option, const std::vector<std::string>& texts) {
  std::vector<TorquePoint> points;
  for (const std::string& text : texts) {
    const std::size_t colon = text.find(':');
    double rate = 0;
    double torque = 0;
    if (colon == std::string::npos || !read_number(std::string_view(text).substr(0, colon), rate) ||
        !read_number(std::string_view(text).substr(colon + 1), torque)) {
      return Failure{MotorError{fmt::format(
          "{}: '{}' is not a point; expected RATE:TORQUE in full steps/s and N\u00B7m, e.g. 1000:0.35", option, text)}};
    }
    points.push_back({Hertz(rate), {torque}});
  }
  return points;
}

Rotor rotor_of(const MotorArguments& arguments) {
  return {.steps_per_revolution = arguments.steps_per_revolution,
          .inertia = {arguments.rotor_inertia * kg_m2_per_g_cm2}};
}

Winding winding_of(const std::string& connection) {
  return connection == "unipolar" ? Winding::half_coil : Winding::whole_coil;
}

struct NamedValue {
  const char* option;
  const std::optional<double>& value;
};

std::vector<NamedValue> motor_values(const MotorArguments& arguments) {
  return {{"--holding-torque", arguments.holding_torque},
          {"--current", arguments.current},
          {"--resistance", arguments.resistance},
          {"--inductance", arguments.inductance},
          {"--supply", arguments.supply}};
}

Result<TorqueCurve, MotorError> measured_curve(const MotorArguments& arguments) {
  for (const NamedValue& named : motor_values(arguments)) {
    if (!named.value) continue;
    return Failure{MotorError{fmt::format("{} and --curve set the same; give only one of them", named.option)}};
  }
  const auto pull_out = read_points("--curve", arguments.pull_out);
  if (!pull_out) return Failure{pull_out.error()};
  const auto pull_in = read_points("--pull-in", arguments.pull_in);
  if (!pull_in) return Failure{pull_in.error()};
  return TorqueCurve::from_points(rotor_of(arguments), *pull_out, *pull_in);
}

// Both need the values of motor_values().
MotorData data_of(const MotorArguments& arguments) {
  return {.rotor = rotor_of(arguments),
          .holding_torque = {*arguments.holding_torque},
          .rated_current = {*arguments.current},
          .resistance = {*arguments.resistance},
          .inductance = {*arguments.inductance * henries_per_millihenry},
          .winding = winding_of(arguments.data.empty() ? arguments.drive : arguments.data)};
}
MotorDrive drive_of(const MotorArguments& arguments) {
  return {.supply = {*arguments.supply},
          .winding = winding_of(arguments.drive),
          .regulation = arguments.regulation == "resistive" ? Regulation::resistive : Regulation::chopper};
}

Result<TorqueCurve, MotorError> curve_of(const MotorArguments& arguments) {
  if (!arguments.pull_out.empty()) return measured_curve(arguments);
  if (!arguments.pull_in.empty()) return Failure{MotorError{"--pull-in needs the pull-out points of --curve"}};
  std::string missing;
  for (const NamedValue& named : motor_values(arguments)) {
    if (!named.value) missing += missing.empty() ? named.option : fmt::format(", {}", named.option);
  }
  if (!missing.empty()) {
    return Failure{MotorError{"the motor data is incomplete: expected --curve, or also " + missing}};
  }
  return TorqueCurve::from_motor(data_of(arguments), drive_of(arguments));
}

Result<MotorScene, MotorError> scene_of(const MotorArguments& arguments) {
  Result<TorqueCurve, MotorError> curve = curve_of(arguments);
  if (!curve) return Failure{curve.error()};
  const Load load{.inertia = {arguments.load_inertia * kg_m2_per_g_cm2},
                  .friction = {arguments.friction},
                  .friction_per_speed = {arguments.friction_per_speed}};
  const Status<MotorError> good = check(load);
  if (!good) return Failure{good.error()};
  if (!(arguments.margin > 0 && arguments.margin <= 1)) {
    return Failure{MotorError{fmt::format("--margin must be between 0 and 1, e.g. 0.7, not {:g}", arguments.margin)}};
  }
  if (arguments.max_rate && !(std::isfinite(*arguments.max_rate) && *arguments.max_rate > 0)) {
    return Failure{MotorError{fmt::format("--max-rate must be above 0 steps/s, not {:g}", *arguments.max_rate)}};
  }
  if (arguments.rows < 2 || arguments.rows > 1'000'000) {
    return Failure{MotorError{fmt::format("--rows must be between 2 and 1000000, not {}", arguments.rows)}};
  }
  const Hertz end = arguments.max_rate ? Hertz(*arguments.max_rate) : natural_end(*curve, load);
  return MotorScene{.curve = *curve, .load = load, .margin = arguments.margin, .end = end};
}

void print_table(const MotorScene& scene, int rows) {
  fmt::print("rate_hz,speed_rad_s,pull_out_nm,pull_in_nm,acceleration_rad_s2\n");
  for (int i = 0; i < rows; ++i) {
    const Hertz rate(scene.end.value() * i / (rows - 1));
    const RadiansPerSecond speed = scene.curve.speed_at(rate);
    fmt::print("{:.10g},{:.10g},{:.10g},{:.10g},{:.10g}\n", rate.value(), speed.value,
               scene.curve.pull_out(speed).value, scene.curve.pull_in(speed, scene.load.inertia).value,
               scene.curve.available_acceleration(speed, scene.load, scene.margin).value);
  }
}

void print_json(const MotorScene& scene) {
  const TorqueCurve& curve = scene.curve;
  const auto rate = [&](RadiansPerSecond speed) { return curve.rate_at(speed).value(); };
  const RadiansPerSecond starting = curve.maximum_starting_speed(scene.load);
  const std::optional<RadiansPerSecond> fastest = curve.fastest_speed(scene.load);
  nlohmann::ordered_json json;
  json["steps_per_revolution"] = curve.rotor().steps_per_revolution;
  json["standstill_torque_nm"] = curve.pull_out({0}).value;
  json["maximum_starting_rate_hz"] = rate(starting);
  json["maximum_starting_speed_rad_s"] = starting.value;
  json["maximum_starting_rate_without_load_hz"] = rate(curve.maximum_starting_speed({}));
  json["fastest_rate_hz"] = nullptr;
  json["fastest_speed_rad_s"] = nullptr;
  if (fastest) {
    json["fastest_rate_hz"] = rate(*fastest);
    json["fastest_speed_rad_s"] = fastest->value;
  }
  json["acceleration_at_rest_rad_s2"] = curve.available_acceleration({0}, scene.load, scene.margin).value;
  json["acceleration_at_starting_rate_rad_s2"] = curve.available_acceleration(starting, scene.load, scene.margin).value;
  fmt::print("{}\n", json.dump(2));
}

// One line that says which motor the picture shows.
std::string motor_text(const MotorArguments& arguments) {
  if (!arguments.pull_out.empty()) return "from measured points";
  return fmt::format("{:g} N\u00B7m, {:g} A, {:g} \u2126, {:g} mH   \u00B7   {:g} V, {} {}", *arguments.holding_torque,
                     *arguments.current, *arguments.resistance, *arguments.inductance, *arguments.supply,
                     arguments.drive, arguments.regulation);
}

std::string load_text(const MotorArguments& arguments) {
  std::string text = fmt::format("rotor {:g} g\u00B7cm\u00B2", arguments.rotor_inertia);
  if (arguments.load_inertia > 0) text += fmt::format(", load {:g} g\u00B7cm\u00B2", arguments.load_inertia);
  if (arguments.friction > 0) text += fmt::format(", friction {:g} N\u00B7m", arguments.friction);
  if (arguments.friction_per_speed > 0)
    text += fmt::format(" + {:g} N\u00B7m\u00B7s/rad", arguments.friction_per_speed);
  if (arguments.margin < 1) text += fmt::format("   \u00B7   margin {:g}", arguments.margin);
  return text;
}

Status<OutputError> write_pictures(const MotorScene& scene, const MotorArguments& arguments) {
  for (const std::string& path : arguments.pictures) {
    Result<OutputFile, OutputError> file = OutputFile::open(path);
    if (!file) return Failure{file.error()};
    const PictureOptions options{.format = *picture_format_of(path),
                                 .program = "Stepping motor: torque over speed",
                                 .machine = motor_text(arguments) + "   \u00B7   " + load_text(arguments)};
    Status<OutputError> done = draw_motor_picture(scene, options, *file);
    if (done) done = file->commit();
    if (!done) return done;
  }
  return Unit{};
}

// The motor of a trial. The scene has been checked.
Result<MotorSetup, MotorError> setup_of(const MotorArguments& arguments, const MotorScene& scene) {
  const auto excitation = Excitation::named(arguments.excitation);
  if (!excitation) return Failure{MotorError{"--excitation: " + excitation.error()}};
  const auto refuse = [](const char* words) { return Failure{MotorError{words}}; };
  if (!(arguments.detent >= 0)) return refuse("--detent must be 0 N\u00B7m or more");
  if (!(arguments.damping >= 0 && arguments.damping <= 10)) return refuse("--damping must be from 0 to 10");
  if (!(arguments.trial_rate >= 0.1 && arguments.trial_rate <= 1e6)) return refuse("--rate must be from 0.1 to 1e6");
  if (arguments.trial_steps < 1 || arguments.trial_steps > 1'000'000)
    return refuse("--steps must be from 1 to 1000000");
  if (!(arguments.trial_after > 0 && arguments.trial_after <= 100)) return refuse("--after must be above 0, to 100 s");
  MotorSetup setup = measured_setup(scene.curve, *excitation);
  if (arguments.pull_out.empty()) {
    setup = {.motor = data_of(arguments), .drive = drive_of(arguments), .excitation = *excitation};
  }
  setup.damping = damping_of(setup.motor, arguments.damping);
  setup.load = scene.load;
  setup.detent = {arguments.detent};
  return setup;
}

}  // namespace

int motor(const MotorArguments& arguments) {
  if (!outputs_are_apart(arguments.pictures, "")) return exit_bad_program;
  for (const std::string& path : arguments.pictures) {
    if (const std::string why = refuse_picture(path); !why.empty()) return fail(exit_bad_program, why);
  }
  const Result<MotorScene, MotorError> scene = scene_of(arguments);
  if (!scene) return fail(exit_bad_program, scene.error().message);
  if (!arguments.trial.empty()) {
    const auto setup = setup_of(arguments, *scene);
    if (!setup) return fail(exit_bad_program, setup.error().message);
    return try_motor(arguments, *setup, scene->end, motor_text(arguments) + "   \u00B7   " + load_text(arguments));
  }
  const Status<OutputError> written = write_pictures(*scene, arguments);
  if (!written) return fail(exit_failed, written.error().message);
  if (arguments.json) {
    print_json(*scene);
  } else if (arguments.pictures.empty()) {
    print_table(*scene, arguments.rows);
  }
  return exit_done;
}

}  // namespace passo
