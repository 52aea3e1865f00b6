#include "cam_job.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "cam_program.hpp"
#include "named_files.hpp"
#include "picture_names.hpp"
#include "progress_display.hpp"

#include "passo/cam/drawn_colour.hpp"

namespace passo {

ProgramUnits program_units_of(const std::string& name) {
  return name == "cm" ? ProgramUnits::cm : name == "inch" ? ProgramUnits::inch : ProgramUnits::mm;
}

int write_text(const std::string& path, const std::string& text) {
  ProgressDisplay::clear_shown();  // the text may go to the same terminal
  Result<OutputFile, OutputError> file = OutputFile::open(path.empty() ? "-" : path);
  if (!file) return fail(exit_failed, file.error().message);
  file->write(text);
  const Status<OutputError> written = file->commit();
  return written ? exit_done : fail(exit_failed, written.error().message);
}

int write_picture(const std::string& path, const std::string& title,
                  const std::function<Status<OutputError>(const PictureOptions&, OutputFile&)>& draw) {
  Result<OutputFile, OutputError> file = OutputFile::open(path);
  if (!file) return fail(exit_failed, file.error().message);
  PictureOptions options;
  options.format = picture_format_of(path).value_or(PictureFormat::svg);
  options.program = title;
  Status<OutputError> done = draw(options, *file);
  if (done) done = file->commit();
  return done ? exit_done : fail(exit_failed, done.error().message);
}

int write_picture(const std::string& path, const std::string& title, const MillScene& scene) {
  return write_picture(path, title, [&](const PictureOptions& options, OutputFile& file) {
    return draw_mill_plan(scene, options, file);
  });
}

void refuse_wrong_colours(const std::vector<std::string>& colors, LengthArguments& lengths, const char* option) {
  const auto wrong = std::ranges::find_if_not(colors, [](const std::string& one) { return is_drawn_colour(one); });
  if (wrong == colors.end()) return;
  lengths.refuse(
      fmt::format("{}: expected a colour, e.g. red, #f00 or rgb(255, 0, 0), or a number of the palette "
                  "of DXF, found '{}'",
                  option, *wrong));
}

ZeroPlace zero_of(const std::string& zero, LengthArguments& lengths) {
  if (zero == "file") return {};
  if (zero == "lower-left") return {.is_lower_left = true};
  if (zero.find(',') == std::string::npos) {
    lengths.refuse(fmt::format("--zero: expected file, lower-left or X,Y, found '{}'", zero));
    return {};
  }
  return {.at = lengths.place("--zero", zero)};
}

Mirror mirror_of(const std::string& turned, const std::string& at, LengthArguments& lengths) {
  Mirror mirror;
  if (turned == "x") mirror.turned = Mirror::Turned::x;
  if (turned == "y") mirror.turned = Mirror::Turned::y;
  if (at.empty()) return mirror;
  if (turned.empty()) lengths.refuse("--mirror-at also needs --mirror x or --mirror y");
  mirror.at = lengths.any("--mirror-at", at);
  return mirror;
}

std::vector<DrawnPoint> align_holes_of(const std::string& align, LengthArguments& lengths) {
  if (align.empty()) return {};
  const std::vector<Nanometres> holes = lengths.list("--align", align);
  if (holes.size() == 4 && (holes[0] == holes[2]) != (holes[1] == holes[3])) {
    return {{holes[0], holes[1]}, {holes[2], holes[3]}};
  }
  lengths.refuse(
      fmt::format("--align: expected X,Y,X,Y of two holes with the same Y or the same X, found '{}'", align));
  return {};
}

namespace {

Mirror mirror_of(const CamMillArguments& arguments, LengthArguments& lengths) {
  const std::vector<DrawnPoint> holes = align_holes_of(arguments.align, lengths);
  if (holes.empty()) return mirror_of(arguments.mirror, arguments.mirror_at, lengths);
  if (!arguments.mirror.empty() || !arguments.mirror_at.empty()) {
    lengths.refuse("--align sets the mirror axis, so it cannot be combined with --mirror or --mirror-at");
  }
  const bool side_by_side = holes[0].y == holes[1].y;
  return {side_by_side ? Mirror::Turned::x : Mirror::Turned::y,
          {side_by_side ? (holes[0].x.count + holes[1].x.count) / 2 : (holes[0].y.count + holes[1].y.count) / 2}};
}

// A program that goes nowhere has the name of its drawing, which its picture shows.
std::string program_name(const std::string& output, const std::vector<std::string>& files, const char* what) {
  const std::string& named = output == "/dev/null" && !files.empty() ? files.front() : output;
  return named.empty() || named == "/dev/null" ? what : std::filesystem::path(named).filename().string();
}

}  // namespace

MillJob mill_job_of(const CamMillArguments& arguments, const char* command, LengthArguments& lengths,
                    const char* what) {
  MillJob job;
  job.reading.dxf = dxf_options_of(arguments, *mm_of_unit(arguments.units), lengths);
  job.reading.svg = {.scale = arguments.scale.value_or(1),
                     .layers = arguments.layers,
                     .colors = arguments.colors,
                     .names = arguments.names};
  job.reading.hpgl = {.scale = arguments.scale.value_or(1), .layers = arguments.layers};
  job.mirror = mirror_of(arguments, lengths);
  MillProgramOptions& program = job.program;
  program.name = program_name(arguments.output, arguments.files, what);
  program.command = command;
  for (const std::string& file : arguments.files) {
    program.files.push_back(std::filesystem::path(file).filename().string());
  }
  job.zero = zero_of(arguments.zero, lengths);
  const std::string zero = job.zero.is_lower_left ? "the lower left corner"
                           : job.zero.at          ? fmt::format("X{:.6g} Y{:.6g} mm of the drawing",
                                                                to_mm(job.zero.at->x).value(), to_mm(job.zero.at->y).value())
                                                  : "the drawing's zero";
  program.remarks.push_back(fmt::format("X0 Y0 is {}, Z0 the face of the {}", zero, what));
  if (job.mirror.turned != Mirror::Turned::no) {
    const bool is_x = job.mirror.turned == Mirror::Turned::x;
    program.remarks.push_back(fmt::format("the {} is flipped {}, about {}{:.6g} mm of the drawing", what,
                                          is_x ? "from left to right" : "from top to bottom", is_x ? "X" : "Y",
                                          to_mm(job.mirror.at).value()));
  }
  program.remarks.insert(program.remarks.end(), arguments.tool_remarks.begin(), arguments.tool_remarks.end());
  program.units = program_units_of(arguments.units);
  program.clearance = lengths.above_0("--clearance", arguments.clearance);
  program.feed = lengths.above_0("--feed", arguments.feed);
  program.plunge_feed = lengths.above_0("--plunge-feed", arguments.plunge_feed);
  if (arguments.spindle > 0) program.spindle = arguments.spindle;
  program.park = lengths.place("--park", arguments.park);
  program.change = safe_change_of(arguments, lengths);
  if (!arguments.sheet.empty()) {
    const DrawnPoint size = lengths.place("--sheet", arguments.sheet);
    if (size.x.count <= 0 || size.y.count <= 0) lengths.refuse("--sheet: expected W,H above 0");
    job.sheet = DrawnBox{{}, size};
  }
  return job;
}

bool outputs_are_good(const CamMillArguments& arguments, const std::string& edge) {
  NamedFiles files;
  for (const std::string& file : arguments.files) files.reads("the file", file);
  files.reads("--edge", edge);
  name_texts_read(arguments, files);
  name_library_read(arguments, files);
  files.writes("--output", arguments.output);
  files.writes("--picture", arguments.picture);
  if (!files.are_apart() || !program_words_are_good(arguments, arguments.units)) return false;
  if (const std::string why = refuse_picture(arguments.picture); !why.empty()) {
    fail(exit_bad_program, why);
    return false;
  }
  return has_room_for_json(arguments.json, arguments.output);
}

bool has_room_for_json(bool json, const std::string& output) {
  const bool has_no_room = json && (output.empty() || output == "-");
  if (has_no_room) fail(exit_bad_program, "--json writes to standard output, so the program needs --output FILE");
  return !has_no_room;
}

std::string listed(const std::vector<std::string>& files) {
  constexpr std::size_t most = 3;
  if (files.size() <= most) return fmt::format("{}", fmt::join(files, ", "));
  return fmt::format("{} and {}", files.front(), counted(files.size() - 1, "other file"));
}

std::optional<BoardLayer> read_layers(const std::vector<std::string>& files, const MillJob& job) {
  Diagnostics findings;
  BoardLayer all;
  std::vector<Region> faces;
  for (const std::string& file : files) {
    BoardLayer layer = read_board_layer(file, job.reading, findings);
    for (const std::string& words : layer.lines.notes) note(file + ": " + words);
    faces.push_back(std::move(layer.face));
    if (layer.bare) all.bare = all.bare ? united(*all.bare, *layer.bare) : std::move(*layer.bare);
    all.lines.file = file;
    std::ranges::move(layer.lines.holes, std::back_inserter(all.lines.holes));
    std::ranges::move(layer.lines.paths, std::back_inserter(all.lines.paths));
  }
  show(findings);
  if (findings.any_error()) return std::nullopt;
  all.face = faces.size() == 1 ? std::move(faces.front()) : united(faces);
  return all;
}

void take_link(const RouteLink& link, RouteLink& route, SafeChange& change) {
  route = link;
  change.changes_in_place = link.changes_in_place;
  change.ends_in_place = link.ends_in_place;
}

void note_repeated(const EdgeLoops& loops) {
  if (loops.repeated == 0) return;
  note(fmt::format("{} that {} ignored", counted(loops.repeated, "closed contour"),
                   loops.repeated == 1 ? "repeats another is" : "repeat others are"));
}

void move_to_zero(const ZeroPlace& zero, const Region& whole, const std::vector<Region*>& regions) {
  const std::optional<DrawnBox> box = bounds(whole);
  const std::optional<DrawnPoint> at = zero.is_lower_left && box ? std::optional(box->least) : zero.at;
  if (!at) return;
  for (Region* region : regions) {
    for (DrawnRing& ring : region->rings) {
      for (DrawnPoint& point : ring) point = {point.x - at->x, point.y - at->y};
    }
  }
}

int tell(const std::string& output, const MillPlan& plan, const std::string& words, CamMade* made) {
  if (made != nullptr) {
    for (const MillTool& tool : plan.tools) {
      made->tools.push_back(tool.words);
      if (!tool.runs.empty()) made->last = tool.runs.back().back().at;
    }
    made->summary = words;
  } else if (!output.empty() && output != "-") {
    say(words);
  }
  return exit_done;
}

std::string summary_of(const MillPlan& plan, DrawnPoint park, const std::string& units, const RouteLink& link) {
  const double unit_nm = *mm_of_unit(units) * nanometres_per_mm;
  std::string text;
  const std::vector<MillLengths> all = lengths_of(plan, park, link);
  for (std::size_t i = 0; i < plan.tools.size(); ++i) {
    const MillLengths& lengths = all[i];
    const std::string links =
        lengths.links_nm > 0 ? fmt::format("{:.1f} {} of links, ", lengths.links_nm / unit_nm, units) : "";
    text += fmt::format("tool {}: {}: {} down, {:.1f} {} milled, {}{:.1f} {} of rapids\n", i + 1, plan.tools[i].words,
                        lengths.runs == 1 ? "once" : counted(lengths.runs, "time"), lengths.milled_nm / unit_nm, units,
                        links, lengths.rapids_nm / unit_nm, units);
  }
  return text;
}

}  // namespace passo
