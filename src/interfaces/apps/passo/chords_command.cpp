// passo chords: a curve cut into chords, within a tolerance or of one length, as numbers or as a picture. With --fine a
// line method steps along the chords: both levels of interpolation.
#include <cmath>
#include <cstdio>
#include <iterator>
#include <optional>

#include "commands.hpp"
#include "curve_arguments.hpp"
#include "named_files.hpp"
#include "picture_names.hpp"
#include "program_input.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "passo/geometry/step_chords.hpp"
#include "passo/report/chord_picture.hpp"
#include "passo/report/curve_pulses_picture.hpp"

namespace passo {
namespace {

// What decides the length of the chords.
struct ChordChoice {
  ChordTolerance tolerance;
  std::optional<ChordLength> length;  // given: chords of this length, whatever the tolerance
};

// Calls use(chords) with the curve cut as chosen.
template <ParametricCurve C, class Use>
auto with_chords(const C& curve, const ChordChoice& choice, const Use& use) {
  if (choice.length) {
    EqualChords<C> chords(curve, *choice.length);
    return use(static_cast<Source<Chord>&>(chords));
  }
  Chords<C> chords(curve, choice.tolerance);
  return use(static_cast<Source<Chord>&>(chords));
}

Result<ChordChoice, std::string> choice_of(const ChordsArguments& arguments) {
  const auto tolerance = ChordTolerance::of(Mm(arguments.tolerance));
  if (!tolerance) return Failure{"--tolerance: " + tolerance.error().message};
  ChordChoice choice{.tolerance = *tolerance, .length = {}};
  if (!arguments.period) return choice;
  if (!(*arguments.period > 0) || !(arguments.feed.value_or(0) > 0)) {
    return Failure{std::string("--period and --feed: expected numbers above 0")};
  }
  const auto length = ChordLength::of(Mm(*arguments.feed / seconds_per_minute * *arguments.period));
  if (!length) return Failure{"--period and --feed: " + length.error().message};
  choice.length = *length;
  return choice;
}

std::string choice_text(const ChordsArguments& arguments, const ChordChoice& choice) {
  if (!choice.length) return fmt::format("Tolerance {:g} mm", arguments.tolerance);
  return fmt::format("Chords of {:.4g} mm: {:g} mm/min in periods of {:g} s", choice.length->value().value(),
                     *arguments.feed, *arguments.period);
}

CurveError too_coarse(std::int64_t number) {
  return {fmt::format(
      "chord {} spans too large an angle to follow its curve; use a shorter --period for shorter chords", number)};
}

Result<StepScale, std::string> scale_of(const std::string& text) {
  const char* const what = "steps/mm above 0, one number or X,Y,Z";
  const auto numbers = numbers_of("--steps-per-mm", text, 1, 3, what);
  if (!numbers) return Failure{numbers.error()};
  const auto good = [](double number) { return number > 0; };
  if (numbers->size() == 2 || !std::ranges::all_of(*numbers, good)) {
    return Failure{fmt::format("--steps-per-mm: expected {}, found '{}'", what, text)};
  }
  return StepScale{{numbers->front(), (*numbers)[numbers->size() / 2], numbers->back()}};
}

void add_row(std::string& text, std::int64_t number, const Vector3& place, Mm deviation) {
  // A formula whose exact result is zero may give 1e-16. Nobody wants to read that, and no machine is that fine.
  const auto clean = [](double mm) { return std::abs(mm) < 1e-12 ? 0.0 : mm; };
  fmt::format_to(std::back_inserter(text), "{},{:.15g},{:.15g},{:.15g},{:.6g}", number, clean(place.x), clean(place.y),
                 clean(place.z), clean(deviation.value()));
}

void add_steps(std::string& text, const StepPlace& place) {
  for (const Steps& steps : place) fmt::format_to(std::back_inserter(text), ",{}", steps.count);
}

std::optional<CurveError> write_chords(const Vector3& start, Source<Chord>& chords, OutputFile& file) {
  std::string text = "chord,x,y,z,deviation\n";
  add_row(text, 0, start, Mm(0));
  std::int64_t number = 0;
  for (Chord chord; !file.failed() && chords.next(chord);) {
    file.write(text + "\n");
    text.clear();
    add_row(text, ++number, chord.end, chord.deviation);
    if (!std::isfinite(chord.deviation.value())) return too_coarse(number);
  }
  file.write(text + "\n");
  return std::nullopt;
}

// A chord that is shorter than a step has no row of its own: the next row includes it.
std::optional<CurveError> write_step_chords(const Vector3& start, Source<Chord>& chords, const StepScale& scale,
                                            OutputFile& file) {
  StepChords steps(chords, start, scale);
  std::string text = "chord,x,y,z,deviation,steps_x,steps_y,steps_z\n";
  add_row(text, 0, start, Mm(0));
  add_steps(text, steps.place());
  std::int64_t number = 0;
  for (StepChord chord; !file.failed() && steps.next(chord);) {
    file.write(text + "\n");
    text.clear();
    add_row(text, ++number, chord.chord.end, chord.chord.deviation);
    add_steps(text, chord.end);
    if (!std::isfinite(chord.chord.deviation.value())) return too_coarse(number);
  }
  file.write(text + "\n");
  return steps.error();
}

int print_chords(const AnyCurve& curve, const ChordChoice& choice, const std::optional<StepScale>& scale,
                 const std::string& path) {
  auto file = OutputFile::open(path.empty() ? "-" : path);
  if (!file) return fail(exit_failed, file.error().message);
  const auto error = std::visit(
      [&](const auto& one) {
        const Vector3 start = one.at(one.range().low);
        return with_chords(one, choice, [&](Source<Chord>& chords) {
          return scale ? write_step_chords(start, chords, *scale, *file) : write_chords(start, chords, *file);
        });
      },
      curve);
  if (error) return fail(exit_bad_program, error->message);
  const Status<OutputError> written = file->commit();
  return written ? exit_done : fail(exit_failed, written.error().message);
}

std::string title_of(const ChordsArguments& arguments) {
  if (arguments.curve == "bezier") {
    return arguments.control.size() == 1 ? "Chords of a quadratic B\u00E9zier" : "Chords of a cubic B\u00E9zier";
  }
  if (arguments.curve == "nurbs") return fmt::format("Chords of a NURBS of degree {}", arguments.degree);
  const bool vowel = arguments.curve == "arc" || arguments.curve == "ellipse";
  return fmt::format("Chords of {} {}", vowel ? "an" : "a", arguments.curve);
}

int draw(const AnyCurve& curve, const ChordChoice& choice, const ChordsArguments& arguments, PictureFormat format) {
  const ChordDrawing drawing = std::visit(
      [&](const auto& one) {
        return choice.length ? record_chords(one, *choice.length) : record_chords(one, choice.tolerance);
      },
      curve);
  const std::size_t count = drawing.ends.size() - 1;
  if (count >= ChordDrawing::most_chords) {
    return fail(exit_bad_program, fmt::format("--picture: {} chords or more are too many to draw; choose a larger {}",
                                              ChordDrawing::most_chords, choice.length ? "--period" : "--tolerance"));
  }
  if (!std::isfinite(drawing.tolerance.value())) {
    return fail(exit_bad_program,
                "a chord spans too large an angle to follow its curve; use a shorter --period for shorter chords");
  }
  auto file = OutputFile::open(arguments.picture);
  if (!file) return fail(exit_failed, file.error().message);
  PictureOptions options{.format = format, .program = title_of(arguments), .machine = {}};
  Status<OutputError> done = draw_chords(drawing, options, *file);
  if (done) done = file->commit();
  return done ? exit_done : fail(exit_failed, done.error().message);
}

// --- the fine level -------------------------------------------------------------------------------------------------

// Plays all pulses along the curve. `use` is called after each of them; it returns false when it has seen enough.
template <class Use>
Result<CurveMeasures, std::string> play(const AnyCurve& curve, const ChordChoice& choice, const StepScale& scale,
                                        const Method& method, const Use& use) {
  return std::visit(
      [&](const auto& one) {
        const auto run = [&](Source<Chord>& chords) -> Result<CurveMeasures, std::string> {
          CurvePulses pulses([&](double u) { return one.at(u); }, one.range(), chords, scale, method);
          for (CurvePulse pulse; pulses.next(pulse);) {
            if (!use(pulse)) break;
          }
          if (pulses.error()) return Failure{*pulses.error()};
          return pulses.measures();
        };
        return with_chords(one, choice, run);
      },
      curve);
}

int print_pulses(const AnyCurve& curve, const ChordChoice& choice, const StepScale& scale, const Method& method,
                 const std::string& path) {
  auto file = OutputFile::open(path.empty() ? "-" : path);
  if (!file) return fail(exit_failed, file.error().message);
  file->write("pulse,chord,steps_x,steps_y,steps_z,deviation\n");
  std::int64_t number = 0;
  const auto done = play(curve, choice, scale, method, [&](const CurvePulse& pulse) {
    file->write(fmt::format("{},{},{},{},{},{:.6g}\n", ++number, pulse.chord, pulse.place[0].count,
                            pulse.place[1].count, pulse.place[2].count, pulse.deviation.value()));
    return !file->failed();
  });
  if (!done) return fail(exit_bad_program, done.error());
  const Status<OutputError> written = file->commit();
  return written ? exit_done : fail(exit_failed, written.error().message);
}

// Places of the curve for a picture, close enough for the eye.
std::vector<Vector3> places_of(const AnyCurve& curve) {
  std::vector<Vector3> places;
  const auto add = [&](const auto& one) {
    constexpr int pieces = 2000;
    const ParameterRange range = one.range();
    for (int i = 0; i <= pieces; ++i) places.push_back(one.at(range.low + (range.high - range.low) * i / pieces));
  };
  std::visit(add, curve);
  return places;
}

int draw_pulses_of(const AnyCurve& curve, const ChordChoice& choice, const StepScale& scale, const Method& method,
                   const ChordsArguments& arguments, PictureFormat format) {
  CurvePulsesScene scene{.method = title(method), .scale = scale, .curve = places_of(curve)};
  const auto start = to_steps(scene.curve.front(), scale);
  if (!start) return fail(exit_bad_program, start.error().message);
  scene.chords = {*start};
  const auto measures = play(curve, choice, scale, method, [&](const CurvePulse& pulse) {
    if (!scene.pulses.empty() && scene.pulses.back().chord != pulse.chord) {
      scene.chords.push_back(scene.pulses.back().place);
    }
    scene.pulses.push_back(pulse);
    return static_cast<std::int64_t>(scene.pulses.size()) <= CurvePulsesScene::most_pulses;
  });
  if (!measures) return fail(exit_bad_program, measures.error());
  if (scene.pulses.empty()) return fail(exit_bad_program, "--picture: the whole curve is shorter than a step");
  if (measures->pulses > CurvePulsesScene::most_pulses) {
    return fail(exit_bad_program,
                fmt::format("--picture: more than {} pulses are too many to draw", CurvePulsesScene::most_pulses));
  }
  scene.chords.push_back(scene.pulses.back().place);
  scene.measures = *measures;
  auto file = OutputFile::open(arguments.picture);
  if (!file) return fail(exit_failed, file.error().message);
  const PictureOptions options{.format = format,
                               .program = title_of(arguments) + ", and pulses along them",
                               .machine = choice_text(arguments, choice)};
  Status<OutputError> done = draw_curve_pulses(scene, options, *file);
  if (done) done = file->commit();
  return done ? exit_done : fail(exit_failed, done.error().message);
}

Result<Method, std::string> fine_method(const ChordsArguments& arguments) {
  const std::optional<MethodName> name = method_named(arguments.fine);
  if (name && right_method_of({.name = *name})) {
    return Failure{std::string("--fine: a faulty listing does not follow a curve; expected a method")};
  }
  if (!name) {
    return Failure{
        fmt::format("--fine: '{}' is not one of {}, bresenham", arguments.fine, fmt::join(method_names(), ", "))};
  }
  if (arguments.steps_per_mm.empty())
    return Failure{std::string("--fine steps along the chords, so it needs --steps-per-mm")};
  return Method{.name = *name};
}

}  // namespace

int chords(const ChordsArguments& arguments) {
  if (!outputs_are_apart({arguments.picture}, arguments.output)) return exit_bad_program;
  const auto curve = curve_of(arguments);
  if (!curve) return fail(exit_bad_program, curve.error());
  const auto choice = choice_of(arguments);
  if (!choice) return fail(exit_bad_program, choice.error());
  std::optional<StepScale> scale;
  if (!arguments.steps_per_mm.empty()) {
    const auto parsed = scale_of(arguments.steps_per_mm);
    if (!parsed) return fail(exit_bad_program, parsed.error());
    scale = *parsed;
  }
  std::optional<Method> fine;
  if (!arguments.fine.empty()) {
    const auto method = fine_method(arguments);
    if (!method) return fail(exit_bad_program, method.error());
    fine = *method;
  }
  if (!arguments.picture.empty()) {
    if (const std::string why = refuse_picture(arguments.picture); !why.empty()) return fail(exit_bad_program, why);
    const std::optional<PictureFormat> format = picture_format_of(arguments.picture);
    const int code = fine ? draw_pulses_of(*curve, *choice, *scale, *fine, arguments, *format)
                          : draw(*curve, *choice, arguments, *format);
    // A picture is an answer by itself. The numbers are written too only if a file for them is named.
    if (code != exit_done || arguments.output.empty()) return code;
  }
  if (fine) return print_pulses(*curve, *choice, *scale, *fine, arguments.output);
  return print_chords(*curve, *choice, scale, arguments.output);
}

}  // namespace passo
