// What the commands of `passo cam` have in common: how files are read, and how programs and pictures are written.
#pragma once

#include <functional>
#include <string>

#include "cam_commands.hpp"
#include "length_arguments.hpp"
#include "program_input.hpp"

#include "passo/cam/board_layer.hpp"
#include "passo/cam/mill_program.hpp"
#include "passo/cam/mirror.hpp"
#include "passo/cam/outline.hpp"
#include "passo/report/mill_picture.hpp"
#include "passo/report/output_file.hpp"

namespace passo {

// `Arguments`: with `scale`, `input` and `layers`.
template <class Arguments>
DxfOptions dxf_options_of(const Arguments& arguments, double unit_mm, LengthArguments& lengths) {
  DxfOptions options;
  if (arguments.scale || !arguments.input.empty()) {
    const double scale = arguments.scale.value_or(1);
    if (!(scale > 1e-9 && scale < 1e9)) {
      lengths.refuse(fmt::format("--scale: expected a number above 0, found {:g}", scale));
    }
    options.unit = Mm(scale * (arguments.input.empty() ? unit_mm : *mm_of_unit(arguments.input)));
  }
  options.layers = arguments.layers;
  return options;
}

// Where X0 Y0 is, of the drawing after it was turned over. Empty: the drawing's own zero.
struct ZeroPlace {
  bool is_lower_left = false;
  std::optional<DrawnPoint> at = {};
};
// "file", "lower-left", or "X,Y".
ZeroPlace zero_of(const std::string& zero, LengthArguments& lengths);

// What --mirror and --mirror-at say.
Mirror mirror_of(const std::string& turned, const std::string& at, LengthArguments& lengths);
// The two places of --align: X,Y,X,Y. Empty: none were given, or they are wrong.
std::vector<DrawnPoint> align_holes_of(const std::string& align, LengthArguments& lengths);

ProgramUnits program_units_of(const std::string& name);

// Writes the text to the file, or without a name to standard output. Returns an exit code.
int write_text(const std::string& path, const std::string& text);
// Draws into the file with `draw`. Returns an exit code.
int write_picture(const std::string& path, const std::string& title,
                  const std::function<Status<OutputError>(const PictureOptions&, OutputFile&)>& draw);

struct MillJob {
  DrawingFileOptions reading;
  MillProgramOptions program;
  Mirror mirror;
  ZeroPlace zero;
  std::optional<DrawnBox> sheet = {};  // the material
};

// What CamMillArguments say. `command`: "passo cam isolate". `what`: the thing that is milled, in comments.
MillJob mill_job_of(const CamMillArguments& arguments, const char* command, LengthArguments& lengths,
                    const char* what = "board");

OutlineOptions outline_options_of(const CamOutlineArguments& arguments, const MillJob& job, LengthArguments& lengths);

// Whether the files are apart, and --picture is a picture. If not, says why.
bool outputs_are_good(const CamMillArguments& arguments, const std::string& edge);

// The files as a finding on all of them names them: "front.svg, back.svg".
std::string listed(const std::vector<std::string>& files);

// Reads the files, and says what was guessed. Findings are shown; then the answer is empty.
std::optional<BoardLayer> read_layers(const std::vector<std::string>& files, const MillJob& job);

// Puts the regions where --zero says; `whole`, one of them, has the lower left corner.
void move_to_zero(const ZeroPlace& zero, const Region& whole, const std::vector<Region*>& regions);

// Prints the words where standard output is free, or puts them into `made`. Returns exit_done.
int tell(const std::string& output, const MillPlan& plan, const std::string& words, CamMade* made);

// What the runs of each tool are, a line each, in the program's units.
std::string summary_of(const MillPlan& plan, DrawnPoint park, const std::string& units);

}  // namespace passo
