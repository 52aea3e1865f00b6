// The options of studies.
#include "cam_rows.hpp"

#include "passo/operations/study_arguments.hpp"

namespace passo {
namespace {

constexpr const char* tune_examples =
    R"(The proposal is checked as by passo check: the verdict for strokes, zigzags and circles at these limits is safe.
The copy keeps all comments. Homing and start-stop velocities above a lowered velocity are lowered with it.

Examples:
  passo tune -m router.toml                                 limits with a torque margin of 30 %
  passo tune -m router.toml --margin 0.5 -o tuned.toml      half of the torque reserved for cutting; write a copy
  passo tune -m router.toml --axes Z --way 10               short moves of one axis
  passo tune -m router.toml --picture curves.svg            available and required torque over speed

Criterion and curves: docs/manual/tuning.md.)";

constexpr CamOperation tune = {.name = "tune",
                               .purpose = "propose velocity, acceleration and jerk limits that suit a machine's motors",
                               .accepts = "",
                               .examples = tune_examples,
                               .options = options_with_defaults<TuneArguments>};

}  // namespace

std::vector<CamOption> cam_options_of(TuneArguments& a) {
  using enum CamKind;
  return {
      {"machine",
       &a.machine,
       file,
       "machine file (TOML) with tables [axis.X.torque]",
       {.matters_to = cli, .letter = "m", .is_required = true}},
      {"margin",
       &a.margin,
       number,
       "fraction of the guaranteed torque that is reserved for cutting",
       {.range = CamRange{0.1, 0.9}}},
      {"axes", &a.axes, text, "axes to tune, e.g. XY (default: all with motor data in the file)"},
      {"way",
       &a.way,
       number,
       "length of the move to optimize for, mm or degrees (default: half of the axis' travel)",
       {.range = CamRange{0.001, 1e6}}},
      {"keep-velocity", &a.keep_velocity, flag,
       "keep the velocities of the file as upper limits, e.g. if a leadscrew limits them"},
      {"output",
       &a.output,
       file,
       "file for a copy of the machine file with the proposed values",
       {.matters_to = cli, .letter = "o"}},
      picture_row(a.picture, "picture of torque over speed (FILE.svg or FILE.png)"),
      {"json", &a.json, flag, "print the proposal as JSON", {.matters_to = cli}},
  };
}

const CamOperation& tune_study() {
  return tune;
}

}  // namespace passo
