#include "cam_part.hpp"

#include <algorithm>
#include <iterator>

#include "cam_program.hpp"
#include "cam_tools.hpp"
#include <fmt/format.h>

#include "passo/base/counted.hpp"
#include "passo/cam/plot_plan.hpp"
#include "passo/diagnostics/file_bytes.hpp"

namespace passo {
namespace {

DrawnBox box_of(const Drawing& drawing) {
  std::vector<DrawnRing> rows;
  for (const DrawnPath& path : drawing.paths) rows.push_back(chords_of_path(path.points, path.is_closed, {10'000}));
  for (const DrawnHole& hole : drawing.holes) {
    const Nanometres radius{hole.diameter.count / 2};
    rows.push_back({{hole.at.x - radius, hole.at.y - radius}, {hole.at.x + radius, hole.at.y + radius}});
  }
  return bounds(Region{rows}).value_or(DrawnBox{});
}

}  // namespace

void check_sheet(const DrawnBox& sheet, const DrawnBox& box, const std::string& file, Diagnostics& findings) {
  const bool fits = box.least.x >= sheet.least.x && box.least.y >= sheet.least.y && box.most.x <= sheet.most.x &&
                    box.most.y <= sheet.most.y;
  if (fits) return;
  findings.add(of_file(
      "profile.off-sheet", file,
      fmt::format(
          "the drawing extends from X{:.6g} Y{:.6g} to X{:.6g} Y{:.6g} mm, beyond the sheet of {:.6g} x {:.6g} mm",
          to_mm(box.least.x).value(), to_mm(box.least.y).value(), to_mm(box.most.x).value(), to_mm(box.most.y).value(),
          to_mm(sheet.most.x).value(), to_mm(sheet.most.y).value()),
      "--zero lower-left, another --scale, or a larger --sheet"));
}

std::optional<Drawing> read_drawings(const CamMillArguments& arguments, const MillJob& job) {
  Diagnostics findings;
  Drawing all;
  for (const std::string& file : arguments.files) {
    Drawing one = read_drawing(file, job.reading, findings);
    for (const std::string& words : one.notes) note(file + ": " + words);
    all.file = file;
    std::ranges::move(one.holes, std::back_inserter(all.holes));
    std::ranges::move(one.paths, std::back_inserter(all.paths));
  }
  show(findings);
  if (findings.any_error()) return std::nullopt;
  return all;
}

std::optional<PartDrawing> part_of(Drawing drawing, const MillJob& job, Nanometres join, OpenRows open_rows) {
  const auto is_point = [](const DrawnHole& hole) { return hole.diameter.count <= 0; };
  const auto points = static_cast<std::size_t>(std::ranges::count_if(drawing.holes, is_point));
  if (points > 0 && open_rows != OpenRows::kept) {
    note(fmt::format("{} without a diameter {} ignored", counted(points, "point"), points == 1 ? "is" : "are"));
  }
  mirror_drawing(drawing, job.mirror);
  if (job.zero.at || job.zero.is_lower_left) {
    move_zero_to(job.zero.is_lower_left ? box_of(drawing).least : *job.zero.at, drawing);
  }
  const DrawnBox box = box_of(drawing);
  std::vector<DrawnPoint> dots;
  if (open_rows == OpenRows::kept) dots = take_dots(drawing);
  Diagnostics findings;
  PartDrawing part{edge_loops(drawing, join, findings, open_rows), box.least, box.most};
  for (const DrawnPoint& dot : dots) part.loops.open.push_back({{dot, 0}});
  note_repeated(part.loops);
  if (job.sheet && !findings.any_error()) check_sheet(*job.sheet, box, drawing.file, findings);
  show(findings);
  if (findings.any_error()) return std::nullopt;
  return part;
}

ProfileSide side_of(const std::string& side) {
  return side == "outside"  ? ProfileSide::outside
         : side == "inside" ? ProfileSide::inside
         : side == "on"     ? ProfileSide::on
                            : ProfileSide::part;
}

std::string size_words(const PartDrawing& part) {
  return fmt::format("drawn: X {:.6g} to {:.6g}, Y {:.6g} to {:.6g} mm\n", to_mm(part.least.x).value(),
                     to_mm(part.most.x).value(), to_mm(part.least.y).value(), to_mm(part.most.y).value());
}

std::string open_lines(const ProfilePlan& plan) {
  const std::string dots = plan.dots == 0 ? "" : ", " + counted(plan.dots, "dot");
  return counted(plan.lines, "open line") + dots;
}

int deliver(const CamMillArguments& arguments, const MillJob& job, const PartResult& result,
            const WorkProgress& progress) {
  for (const std::string& words : result.mill.notes) note(words);
  if (const int code = write_program(arguments, result.mill, job.program); code != exit_done) {
    return code;
  }
  progress.update(0.5);
  if (!arguments.picture.empty()) {
    const MillScene scene{.plan = result.mill,
                          .face = result.face,
                          .face_name = "Drawn",
                          .warned = result.unreached,
                          .marks = result.tabs,
                          .mark_name = "Tab",
                          .park = job.program.park,
                          .warned_name = "Not reached",
                          .sheet = job.sheet,
                          .offcut = result.offcut};
    const int code = write_picture(arguments.picture, job.program.name, scene);
    if (code != exit_done) return code;
  }
  progress.update(1);
  if (arguments.json) {
    if (!result.json.is_null()) say_summary(result.json, arguments);
    return exit_done;
  }
  return tell(arguments.output, result.mill, summary_of(result.mill, job.program.park, arguments.units) + result.words,
              nullptr);
}

}  // namespace passo
