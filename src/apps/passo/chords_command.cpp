// passo chords: a curve cut into chords within a tolerance, as numbers or as a picture.
#include <cmath>
#include <cstdio>
#include <iterator>
#include <optional>

#include "commands.hpp"
#include "curve_arguments.hpp"
#include "named_files.hpp"
#include "program_input.hpp"
#include <fmt/format.h>

#include "passo/geometry/step_chords.hpp"
#include "passo/report/chord_picture.hpp"

namespace passo {
namespace {

Result<StepScale, std::string> scale_of(const std::string& text) {
  const char* const what = "steps a millimetre above 0, one number or X,Y,Z";
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

template <ParametricCurve C>
std::optional<CurveError> write_chords(const C& curve, ChordTolerance tolerance, OutputFile& file) {
  Chords chords(curve, tolerance);
  std::string text = "chord,x,y,z,deviation\n";
  add_row(text, 0, curve.at(curve.range().low), Mm(0));
  std::int64_t number = 0;
  for (Chord chord; !file.failed() && chords.next(chord);) {
    file.write(text + "\n");
    text.clear();
    add_row(text, ++number, chord.end, chord.deviation);
  }
  file.write(text + "\n");
  return std::nullopt;
}

// A chord that is shorter than a step has no row of its own: the next row includes it.
template <ParametricCurve C>
std::optional<CurveError> write_step_chords(const C& curve, ChordTolerance tolerance, const StepScale& scale,
                                            OutputFile& file) {
  const Vector3 start = curve.at(curve.range().low);
  Chords chords(curve, tolerance);
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
  }
  file.write(text + "\n");
  return steps.error();
}

int print_chords(const AnyCurve& curve, ChordTolerance tolerance, const ChordsArguments& arguments) {
  std::optional<StepScale> scale;
  if (!arguments.steps_per_mm.empty()) {
    const auto parsed = scale_of(arguments.steps_per_mm);
    if (!parsed) return fail(exit_bad_program, parsed.error());
    scale = *parsed;
  }
  auto file = OutputFile::open(arguments.output.empty() ? "-" : arguments.output);
  if (!file) return fail(exit_failed, file.error().message);
  const auto error = std::visit(
      [&](const auto& one) {
        return scale ? write_step_chords(one, tolerance, *scale, *file) : write_chords(one, tolerance, *file);
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

int draw(const AnyCurve& curve, ChordTolerance tolerance, const ChordsArguments& arguments) {
  const std::optional<PictureFormat> format = picture_format_of(arguments.picture);
  if (!format)
    return fail(exit_bad_program, fmt::format("--picture: '{}' should end in .svg or .png", arguments.picture));
  const ChordDrawing drawing = std::visit([&](const auto& one) { return record_chords(one, tolerance); }, curve);
  const std::size_t count = drawing.ends.size() - 1;
  if (count >= ChordDrawing::most_chords) {
    return fail(exit_bad_program,
                fmt::format("--picture: {} chords or more are too many to be seen; choose a larger --tolerance",
                            ChordDrawing::most_chords));
  }
  auto file = OutputFile::open(arguments.picture);
  if (!file) return fail(exit_failed, file.error().message);
  PictureOptions options{.format = *format, .program = title_of(arguments), .machine = {}};
  Status<OutputError> done = draw_chords(drawing, options, *file);
  if (done) done = file->commit();
  return done ? exit_done : fail(exit_failed, done.error().message);
}

}  // namespace

int chords(const ChordsArguments& arguments) {
  if (!outputs_are_apart({arguments.picture}, arguments.output)) return exit_bad_program;
  const auto curve = curve_of(arguments);
  if (!curve) return fail(exit_bad_program, curve.error());
  const auto tolerance = ChordTolerance::of(Mm(arguments.tolerance));
  if (!tolerance) return fail(exit_bad_program, "--tolerance: " + tolerance.error().message);
  if (arguments.picture.empty()) return print_chords(*curve, *tolerance, arguments);
  const int code = draw(*curve, *tolerance, arguments);
  // A picture is an answer by itself. The numbers are written too only if a file for them is named.
  if (code != exit_done || arguments.output.empty()) return code;
  return print_chords(*curve, *tolerance, arguments);
}

}  // namespace passo
