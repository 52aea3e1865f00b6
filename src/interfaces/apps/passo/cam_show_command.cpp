// passo cam show: which layers the files of a circuit board have.
#include <algorithm>

#include "cam_job.hpp"
#include "cam_show_shapes.hpp"
#include "cam_tools.hpp"
#include "named_files.hpp"
#include "picture_names.hpp"
#include "program_input.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/cam/board_job.hpp"
#include "passo/report/board_picture.hpp"

namespace passo {
namespace {

const std::vector<std::string>& notes_of(const BoardFile& file) {
  return file.layer ? file.layer->strokes.notes : file.drills->notes;
}

struct ShownSize {
  double across = 0;  // mm
  double up = 0;
};
ShownSize size_of(const std::optional<DrawnBox>& box) {
  if (!box) return {};
  return {to_mm(box->most.x - box->least.x).value(), to_mm(box->most.y - box->least.y).value()};
}

// A row of the table: what a user needs to tell whether this is the layer.
std::string row_of(const BoardFile& file, std::size_t name_width) {
  std::string row =
      fmt::format("{:{}}  {:<16}  {:<9}  ", short_name(file), name_width, words_for(file.kind), file.kind.told_by);
  if (file.layer) {
    const ShownSize size = size_of(bounds(file.layer->dark));
    return row + fmt::format("{:7.2f} x {:7.2f} mm  {:9.2f} mm²  {}, {}\n", size.across, size.up,
                             area_mm2(file.layer->dark), counted(file.layer->pads.size(), "pad"),
                             counted(file.layer->strokes.paths.size(), "stroke"));
  }
  return row + fmt::format("{}, {}\n", counted(file.drills->holes.size(), "hole"),
                           counted(file.drills->paths.size(), "slot"));
}

nlohmann::ordered_json as_json(const BoardFile& file) {
  nlohmann::ordered_json json = {
      {"file", file.name}, {"layer", words_for(file.kind)}, {"told_by", file.kind.told_by}, {"notes", notes_of(file)}};
  if (file.layer) {
    const GerberLayer& layer = *file.layer;
    if (const std::optional<DrawnBox> box = bounds(layer.dark)) {
      json["least_mm"] = {to_mm(box->least.x).value(), to_mm(box->least.y).value()};
      json["most_mm"] = {to_mm(box->most.x).value(), to_mm(box->most.y).value()};
    }
    json["area_mm2"] = area_mm2(layer.dark);
    json["pads"] = layer.pads.size();
    json["strokes"] = layer.strokes.paths.size();
    json["apertures"] = layer.apertures.size();
    json["nets"] = layer.nets.size() - 1;
    json["negative"] = layer.is_negative;
  } else {
    json["holes"] = file.drills->holes.size();
    json["slots"] = file.drills->paths.size();
  }
  return json;
}

void print_json(const BoardJob& job) {
  nlohmann::ordered_json files = nlohmann::ordered_json::array();
  for (const BoardFile& file : job.files) files.push_back(as_json(file));
  const Region face = board_face(job);
  const ShownSize size = size_of(bounds(face));
  nlohmann::ordered_json json = {{"files", std::move(files)}, {"left_out", job.left_out}};
  if (!face.empty()) json["board"] = {{"across_mm", size.across}, {"up_mm", size.up}, {"area_mm2", area_mm2(face)}};
  say_summary(std::move(json));
}

void print_table(const BoardJob& job) {
  std::size_t width = 4;
  for (const BoardFile& file : job.files) width = std::max(width, short_name(file).size());
  for (const BoardFile& file : job.files) fmt::print("{}", row_of(file, width));
  const Region face = board_face(job);
  if (const std::optional<DrawnBox> box = bounds(face)) {
    const ShownSize size = size_of(box);
    fmt::print("board: {:.2f} x {:.2f} mm, {:.2f} mm² within its outline\n", size.across, size.up, area_mm2(face));
  }
}

}  // namespace

int cam_show(const CamShowArguments& arguments) {
  const RecordedMessages shown_ones;
  if (arguments.shapes) return cam_show_shapes(arguments);
  NamedFiles files;
  for (const std::string& file : arguments.files) files.reads("the file", file);
  files.writes("--picture", arguments.picture);
  if (!files.are_apart()) return exit_bad_program;
  const std::optional<PictureFormat> format = picture_format_of(arguments.picture);
  if (const std::string why = refuse_picture(arguments.picture); !why.empty()) return fail(exit_bad_program, why);
  Diagnostics findings;
  const BoardJob job = read_board_job(arguments.files, findings);
  for (const BoardFile& file : job.files) {
    for (const std::string& words : notes_of(file)) note(file.name + ": " + words);
  }
  if (!job.left_out.empty())
    note(fmt::format("{} ignored: not Gerber files, drill files or boards", job.left_out.size()));
  if (findings.any_error()) {
    show(findings);
    return exit_bad_program;
  }
  arguments.json ? print_json(job) : print_table(job);
  if (!format) return exit_done;
  return write_picture(arguments.picture, arguments.files.front(),
                       [&](const PictureOptions& options, OutputFile& file) { return draw_board(job, options, file); });
}

}  // namespace passo
