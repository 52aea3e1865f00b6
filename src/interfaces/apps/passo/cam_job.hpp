// Functions shared by the commands of `passo cam`: reading files, and writing programs and pictures.
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

void refuse_wrong_colours(const std::vector<std::string>& colors, LengthArguments& lengths,
                          const char* option = "--color");

// `Arguments`: a struct with `scale`, `input` and `layers`.
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
  if constexpr (requires { arguments.colors; }) refuse_wrong_colours(arguments.colors, lengths);
  return options;
}

// The position of X0 Y0 in the drawing, after mirroring. Empty: the drawing's own zero.
struct ZeroPlace {
  bool is_lower_left = false;
  std::optional<DrawnPoint> at = {};
};
// Parses "file", "lower-left", or "X,Y".
ZeroPlace zero_of(const std::string& zero, LengthArguments& lengths);

// Parses --mirror and --mirror-at.
Mirror mirror_of(const std::string& turned, const std::string& at, LengthArguments& lengths);
// Parses the two positions of --align: X,Y,X,Y. Empty if there are none, or if they are invalid.
std::vector<DrawnPoint> align_holes_of(const std::string& align, LengthArguments& lengths);

ProgramUnits program_units_of(const std::string& name);

// Writes the text to the file, or to standard output if the name is empty. Returns an exit code.
int write_text(const std::string& path, const std::string& text);
// Draws into the file by calling `draw`. Returns an exit code.
int write_picture(const std::string& path, const std::string& title,
                  const std::function<Status<OutputError>(const PictureOptions&, OutputFile&)>& draw);
int write_picture(const std::string& path, const std::string& title, const MillScene& scene);

struct MillJob {
  DrawingFileOptions reading;
  MillProgramOptions program;
  Mirror mirror;
  ZeroPlace zero;
  std::optional<DrawnBox> sheet = {};  // the sheet of material
};

// Converts CamMillArguments. `command`: "passo cam isolate". `what`: the milled object, for comments.
MillJob mill_job_of(const CamMillArguments& arguments, const char* command, LengthArguments& lengths,
                    const char* what = "board");

OutlineOptions outline_options_of(const CamOutlineArguments& arguments, const MillJob& job, LengthArguments& lengths);

// Checks that all files are different, and that --picture is a picture. Shows a message if not.
bool outputs_are_good(const CamMillArguments& arguments, const std::string& edge);
// Checks that a summary as JSON does not go where the program goes. Shows a message if it does.
bool has_room_for_json(bool json, const std::string& output);

// Joins the file names for a finding about all of them: "front.svg, back.svg".
std::string listed(const std::vector<std::string>& files);

// Reads the files, and shows guesses as notes. Returns nothing after errors, which it shows.
std::optional<BoardLayer> read_layers(const std::vector<std::string>& files, const MillJob& job);

// Shows how many closed contours repeat others, and are ignored.
void note_repeated(const EdgeLoops& loops);

// Makes a program a part of a longer route.
void take_link(const RouteLink& link, RouteLink& route, SafeChange& change);

// Moves the regions according to --zero; `whole`, one of them, defines the lower left corner.
void move_to_zero(const ZeroPlace& zero, const Region& whole, const std::vector<Region*>& regions);

// Prints the text if standard output is not used by the program, or adds it to `made`. Returns exit_done.
int tell(const std::string& output, const MillPlan& plan, const std::string& words, CamMade* made);

// Summarises the runs of each tool, one per line, in the program's units.
std::string summary_of(const MillPlan& plan, DrawnPoint park, const std::string& units, const RouteLink& link = {});

}  // namespace passo
