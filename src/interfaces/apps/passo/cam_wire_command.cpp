// passo cam wire: a program that cuts foam with a hot wire.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include "cam_part.hpp"
#include "cam_program.hpp"
#include "cam_tools.hpp"
#include "wire_kerfs.hpp"
#include <nlohmann/json.hpp>

#include "passo/base/sensible_number.hpp"
#include "passo/cam/airfoil.hpp"
#include "passo/cam/wire_core.hpp"
#include "passo/cam/wire_program.hpp"
#include "passo/diagnostics/file_bytes.hpp"
#include "passo/post_processor/controller_words.hpp"
#include "passo/report/wire_picture.hpp"

namespace passo {
namespace {

// The position of a spar in one profile.
struct SparPlace {
  Nanometres x{};                    // if there are no percent
  std::optional<double> share = {};  // of the width of the profile, from 0 to 1
};
struct SparArgument {
  WireSpar spar;
  std::array<SparPlace, 2> at;  // left and right
};

SparPlace spar_place(const std::string& text, LengthArguments& lengths) {
  if (!text.ends_with('%')) return {.x = lengths.any("--spar", text)};
  double percent = -1;
  const auto end = std::from_chars(text.data(), text.data() + text.size() - 1, percent);
  if (end.ec != std::errc() || end.ptr != text.data() + text.size() - 1 || !(percent >= 0 && percent <= 100)) {
    lengths.refuse(fmt::format("--spar: expected a place from 0% to 100%, found '{}'", text));
  }
  return {.share = percent / 100};
}

// --spar AT,WIDTH,DEPTH[,below].
SparArgument spar_of(const std::string& text, LengthArguments& lengths) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    words.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  SparArgument argument;
  argument.spar.is_below = words.size() == 4 && words[3] == "below";
  if (words.size() != 3 && !argument.spar.is_below) {
    lengths.refuse(
        fmt::format("--spar: expected AT,WIDTH,DEPTH or AT,WIDTH,DEPTH,below, e.g. 30%,6,8, found '{}'", text));
    return argument;
  }
  const std::size_t colon = words[0].find(':');
  argument.at[0] = spar_place(words[0].substr(0, colon), lengths);
  argument.at[1] = colon == std::string::npos ? argument.at[0] : spar_place(words[0].substr(colon + 1), lengths);
  argument.spar.width = lengths.above_0("--spar", words[1]);
  argument.spar.depth = lengths.above_0("--spar", words[2]);
  return argument;
}

struct WireJob {
  WireOptions cut;
  bool has_four_axes = false;
  std::vector<Nanometres> chords;  // of airfoils
  DrawnPoint right_at = {};
  double right_turn = 0;  // radians
  Nanometres join = {};
  std::optional<DrawnBox> block = {};
  AirfoilCurve curve = AirfoilCurve::spline;
  Nanometres skin = {};
  std::vector<SparArgument> spars = {};
};

// Where the profiles lie along the wire.
void find_span(const CamWireArguments& arguments, WireJob& job, LengthArguments& lengths) {
  if (arguments.span.empty() || arguments.width.empty()) {
    lengths.refuse("four axes need --span (between the towers) and --width (of the block)");
    return;
  }
  job.cut.span = lengths.above_0("--span", arguments.span);
  const Nanometres width = lengths.above_0("--width", arguments.width);
  job.cut.left_face = arguments.block_at.empty() ? Nanometres{(job.cut.span.count - width.count) / 2}
                                                 : lengths.any("--block-at", arguments.block_at);
  job.cut.right_face = job.cut.left_face + width;
  if (job.cut.left_face.count < 0 || job.cut.right_face > job.cut.span) {
    lengths.refuse("--width, --block-at: the block must be between the towers (--span)");
  }
}

void choose_core(const CamWireArguments& arguments, WireJob& job, LengthArguments& lengths) {
  if (arguments.straight) job.curve = AirfoilCurve::lines;
  job.skin = lengths.any("--skin", arguments.skin);
  if (job.skin.count < 0) lengths.refuse("--skin: expected a length of 0 or more");
  constexpr std::size_t most_spars = 100;
  if (arguments.spars.size() > most_spars) lengths.refuse("--spar: expected at most 100 slots");
  for (const std::string& text : arguments.spars) {
    if (!lengths.message().empty()) return;
    job.spars.push_back(spar_of(text, lengths));
    const double kerf = kerf_at(job.cut.kerf, job.cut.feed);
    if (lengths.message().empty() && to_mm(job.spars.back().spar.width).value() <= kerf) {
      lengths.refuse(
          fmt::format("--spar: the wire melts {:.3g} mm, so expected a wider slot than in '{}'", kerf, text));
    }
  }
  if (job.cut.keeps != WireKeeps::inside && (job.skin.count > 0 || !job.spars.empty())) {
    lengths.refuse("--skin and --spar are for the core of a wing, so expected --keep inside");
  }
}

WireJob wire_job_of(const CamWireArguments& arguments, LengthArguments& lengths) {
  WireJob job;
  WireOptions& cut = job.cut;
  cut.keeps = arguments.keep == "line"      ? WireKeeps::line
              : arguments.keep == "outside" ? WireKeeps::outside
                                            : WireKeeps::inside;
  cut.feed = to_mm(lengths.above_0("--feed", arguments.feed)).value();
  cut.most_feed =
      arguments.most_feed.empty() ? 3 * cut.feed : to_mm(lengths.above_0("--most-feed", arguments.most_feed)).value();
  if (cut.most_feed < cut.feed) lengths.refuse("--most-feed: expected the feed or more");
  cut.kerf = kerfs_of("--kerf", arguments.kerf, cut.feed, lengths);
  if (cut.keeps == WireKeeps::line) cut.kerf = {{cut.feed, 0}};
  cut.lead = lengths.any("--lead", arguments.lead);
  if (cut.lead.count < 0) lengths.refuse("--lead: expected a length of 0 or more");
  cut.tolerance = lengths.above_0("--tolerance", arguments.tolerance);
  job.has_four_axes = arguments.axes.empty() ? arguments.files.size() > 1 : arguments.axes == "XYUV";
  if (!job.has_four_axes && arguments.files.size() > 1) {
    lengths.refuse("--axes XY: both ends of the wire move together, so only one profile is possible");
  }
  if (job.has_four_axes) find_span(arguments, job, lengths);
  if (!arguments.chord.empty()) {
    job.chords = lengths.list("--chord", arguments.chord);
    const bool is_good = (job.chords.size() == 1 || job.chords.size() == 2) &&
                         std::ranges::all_of(job.chords, [](Nanometres chord) { return chord.count > 0; });
    if (!is_good) lengths.refuse("--chord: expected one length above 0, or LEFT,RIGHT");
  }
  job.right_at = lengths.place("--right-at", arguments.right_at);
  job.right_turn = arguments.right_turn / 180 * std::numbers::pi;
  job.join = lengths.any("--join", arguments.join);
  choose_core(arguments, job, lengths);
  if (!arguments.block.empty()) {
    const std::vector<Nanometres> corners = lengths.list("--block", arguments.block);
    if (corners.size() != 4 || corners[0] >= corners[2] || corners[1] >= corners[3]) {
      lengths.refuse("--block: expected X,Y,X,Y, the lower left and the upper right corner");
    } else {
      job.block = DrawnBox{{corners[0], corners[1]}, {corners[2], corners[3]}};
      job.cut.block_end = corners[2];
    }
  }
  return job;
}

// The drawing of one side. Findings are shown; then the answer is empty.
std::optional<Drawing> read_side(const std::string& file, std::size_t side, const WireJob& wire, const MillJob& job) {
  Diagnostics findings;
  const auto bytes =
      read_bytes(file, {.area = "drawing", .expected = "a drawing (SVG, DXF, HPGL) or an airfoil"}, findings);
  Drawing drawing;
  if (bytes && looks_like_airfoil(*bytes)) {
    if (wire.chords.empty()) {
      fail(exit_bad_program, file + " is an airfoil, which has no size; give --chord");
      return std::nullopt;
    }
    const Nanometres chord = wire.chords[std::min(side, wire.chords.size() - 1)];
    drawing = read_airfoil(file, *bytes, to_mm(chord), findings, wire.curve);
  } else if (bytes) {
    drawing = read_drawing(file, job.reading, findings);
  }
  for (const std::string& words : drawing.notes) note(file + ": " + words);
  show(findings);
  if (findings.any_error()) return std::nullopt;
  return drawing;
}

// The one line of a drawing. Findings are shown; then the answer is empty.
std::optional<WireProfile> profile_of(const std::string& file, const Drawing& drawing, const WireJob& wire) {
  Diagnostics findings;
  EdgeLoops rows = edge_loops(drawing, wire.join, findings, OpenRows::kept);
  const std::size_t count = rows.loops.size() + rows.open.size();
  if (!findings.any_error() && count != 1) {
    findings.add(of_file(count == 0 ? "wire.no-line" : "wire.several-lines", file,
                         count == 0
                             ? "there is no line for the wire to follow"
                             : fmt::format("there are {} lines, but the wire cannot lift off between them", count),
                         "one line, arc, curve or circle; --layer selects it, a larger --join joins its parts"));
  }
  show(findings);
  if (findings.any_error()) return std::nullopt;
  if (!rows.loops.empty()) return WireProfile{std::move(rows.loops.front()), true};
  if (wire.cut.keeps == WireKeeps::line) return WireProfile{std::move(rows.open.front()), false};
  fail(exit_bad_program, file + ": the line is open, so it has no inside; use --keep line");
  return std::nullopt;
}

// The foam within the skin, with the slots for spars. Shows findings, and returns nothing if there are errors.
std::optional<WireProfile> core_of(const std::string& file, const WireJob& wire, std::size_t side,
                                   const WireProfile& profile) {
  if (wire.skin.count == 0 && wire.spars.empty()) return profile;
  const DrawnBox box = box_of(chords_of_path(profile.points, true, wire.cut.tolerance));
  WireCore core{wire.skin, {}};
  for (const SparArgument& argument : wire.spars) {
    WireSpar spar = argument.spar;
    const SparPlace& at = argument.at[side];
    const auto width = static_cast<double>(box.most.x.count - box.least.x.count);
    spar.at = at.share ? Nanometres{box.least.x.count + std::llround(*at.share * width)} : at.x;
    core.spars.push_back(spar);
  }
  Diagnostics findings;
  std::optional<WireProfile> made = wire_core(profile, core, findings);
  show(findings, file);
  return made;
}

void place_right(const WireJob& wire, WireProfile& profile) {
  const double c = std::cos(wire.right_turn);
  const double s = std::sin(wire.right_turn);
  for (PathPoint& point : profile.points) {
    const auto x = static_cast<double>(point.at.x.count);
    const auto y = static_cast<double>(point.at.y.count);
    point.at = {{wire.right_at.x.count + std::llround(x * c - y * s)},
                {wire.right_at.y.count + std::llround(x * s + y * c)}};
  }
}

std::optional<std::vector<WireProfile>> read_profiles(const CamWireArguments& arguments, const WireJob& wire,
                                                      const MillJob& job) {
  std::vector<WireProfile> profiles;
  std::optional<DrawnPoint> zero = job.zero.at;
  for (std::size_t side = 0; side < arguments.files.size(); ++side) {
    std::optional<Drawing> drawing = read_side(arguments.files[side], side, wire, job);
    if (!drawing) return std::nullopt;
    std::optional<WireProfile> profile = profile_of(arguments.files[side], *drawing, wire);
    if (!profile) return std::nullopt;
    // The right profile keeps its place beside the left one.
    if (job.zero.is_lower_left && !zero) {
      zero = box_of(chords_of_path(profile->points, profile->is_closed, wire.cut.tolerance)).least;
    }
    if (zero) {
      for (PathPoint& point : profile->points) point.at = {point.at.x - zero->x, point.at.y - zero->y};
    }
    std::optional<WireProfile> core = core_of(arguments.files[side], wire, side, *profile);
    if (!core) return std::nullopt;
    profiles.push_back(std::move(*core));
  }
  if (profiles.size() == 1) profiles.push_back(profiles.front());
  if (profiles[0].is_closed != profiles[1].is_closed) {
    fail(exit_bad_program, "one profile is closed and the other is open; expected two closed or two open profiles");
    return std::nullopt;
  }
  if (wire.has_four_axes) place_right(wire, profiles[1]);
  return profiles;
}

std::string side_words(const char* name, const WireSide& side) {
  std::string words = fmt::format("{}: {:.1f} mm, at most {} mm/min, kerf {:.3g}", name, side.way,
                                  sensible_number(side.most_speed, 4), side.most_kerf);
  if (side.most_kerf - side.least_kerf > 1e-3) words += fmt::format(" to {:.3g}", side.least_kerf);
  return words + fmt::format(" mm; {:.3g} mm² of the part lost\n", side.lost_mm2);
}

nlohmann::ordered_json side_json(const WireSide& side) {
  return {{"way_mm", side.way},
          {"most_speed", side.most_speed},
          {"least_kerf_mm", side.least_kerf},
          {"most_kerf_mm", side.most_kerf},
          {"lost_mm2", side.lost_mm2}};
}

WireProgramOptions program_of(const CamWireArguments& arguments, const WireJob& wire, const MillJob& job) {
  WireProgramOptions program;
  program.name = job.program.name;
  program.files = job.program.files;
  program.units = job.program.units;
  program.has_four_axes = wire.has_four_axes;
  program.feed = wire.cut.feed;
  program.heat = arguments.heat;
  program.remarks = {fmt::format("{}: at {:.4g} mm/min the kerf is {:.3g} mm",
                                 wire.has_four_axes ? "X Y is the left end of the wire, U V the right one"
                                                    : "both ends of the wire move together",
                                 wire.cut.feed, kerf_at(wire.cut.kerf, wire.cut.feed)),
                     "before the start, the wire must be clear of the block: it moves straight to the first point"};
  if (wire.has_four_axes) {
    program.remarks.push_back(fmt::format("span {:.6g} mm, profiles at {:.6g} and {:.6g} mm from the left end",
                                          to_mm(wire.cut.span).value(), to_mm(wire.cut.left_face).value(),
                                          to_mm(wire.cut.right_face).value()));
  }
  return program;
}

}  // namespace

int cam_wire(const CamWireArguments& arguments, const WorkProgress& progress) {
  if (!outputs_are_good(arguments, "")) return exit_bad_program;
  LengthArguments lengths(*mm_of_unit(arguments.units));
  const MillJob job = mill_job_of(arguments, "passo cam wire", lengths, "block");
  const WireJob wire = wire_job_of(arguments, lengths);
  if (!lengths.message().empty()) return fail(exit_bad_program, lengths.message());
  const ControllerWords* const controller = find_controller(arguments.controller);
  if (wire.has_four_axes && controller != nullptr && !controller->knows_letter('U')) {
    return fail(exit_bad_program,
                fmt::format("--for {}: {} has no axes U and V; expected --axes XY, or --for linuxcnc or grblhal",
                            arguments.controller, controller->title));
  }
  const auto profiles = read_profiles(arguments, wire, job);
  if (!profiles) return exit_bad_program;
  Diagnostics findings;
  const WirePlan plan = plan_wire_cut((*profiles)[0], (*profiles)[1], wire.cut, findings);
  show(findings, listed(arguments.files));
  if (findings.any_error()) return exit_bad_program;
  progress.update(0.8);
  const int written =
      write_program(arguments, write_wire_program(plan, program_of(arguments, wire, job)), job.program.name, {});
  if (written != exit_done) return written;
  if (!arguments.picture.empty()) {
    const WireScene scene{plan, wire.block, wire.has_four_axes};
    const int code = write_picture(
        arguments.picture, job.program.name,
        [&](const PictureOptions& picture, OutputFile& file) { return draw_wire_cut(scene, picture, file); });
    if (code != exit_done) return code;
  }
  progress.update(1);
  double minutes = 0;
  for (const double time : plan.minutes) minutes += time;
  if (arguments.json) {
    nlohmann::ordered_json json = {{"axes", wire.has_four_axes ? "XYUV" : "XY"},
                                   {"moves", plan.faces.size() - 1},
                                   {"sections", plan.sections},
                                   {"minutes_at_feed", minutes},
                                   {"left", side_json(plan.left)}};
    if (wire.has_four_axes) json["right"] = side_json(plan.right);
    say_summary(std::move(json), arguments);
  } else if (!arguments.output.empty() && arguments.output != "-") {
    fmt::print("{} in {}, {:.2f} min at the feed rate\n{}", counted(plan.faces.size() - 1, "move"),
               counted(plan.sections, "section"), minutes,
               side_words(wire.has_four_axes ? "left" : "both ends", plan.left));
    if (wire.has_four_axes) fmt::print("{}", side_words("right", plan.right));
  }
  return exit_done;
}

}  // namespace passo
