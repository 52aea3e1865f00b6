#include "cam_laser_job.hpp"

#include <charconv>

#include "cam_part.hpp"
#include "cam_program.hpp"

namespace passo {
namespace {

constexpr Nanometres finest_line{10'000};
constexpr Nanometres widest_line{10'000'000};

// Two numbers with a sign between them.
template <class Number>
std::optional<std::pair<Number, Number>> pair_of(const std::string& text, char between) {
  std::pair<Number, Number> both;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, both.first);
  if (first.ec != std::errc() || first.ptr == end || *first.ptr != between) return std::nullopt;
  const auto second = std::from_chars(first.ptr + 1, end, both.second);
  if (second.ec != std::errc() || second.ptr != end) return std::nullopt;
  return both;
}

LaserProgramOptions laser_program_of(const CamLaserArguments& arguments, const MillJob& job, LengthArguments& lengths) {
  LaserProgramOptions program;
  program.name = job.program.name;
  program.files = job.program.files;
  program.remarks = job.program.remarks;
  program.units = job.program.units;
  program.beam = arguments.beam == "constant" ? BeamMode::constant : BeamMode::dynamic;
  program.most_s = arguments.max_s;
  program.acceleration = MmPerSecond2(arguments.acceleration);
  program.rapid = lengths.above_0("--rapid", arguments.rapid);
  program.air = arguments.air == "mist" ? "M7" : arguments.air == "flood" ? "M8" : "";
  if (!arguments.focus.empty()) program.focus = lengths.any("--focus", arguments.focus);
  program.park = job.program.park;
  return program;
}

void take_lines(const CamLaserArguments& arguments, LaserJob& job, LengthArguments& lengths) {
  job.lines.side = side_of(arguments.side);
  job.lines.kerf = lengths.any("--kerf", arguments.kerf);
  constexpr Nanometres widest{10'000'000};
  if (job.lines.kerf.count < 0 || job.lines.kerf > widest) {
    lengths.refuse(fmt::format("--kerf: expected a width from 0 to 10 mm, found '{}'", arguments.kerf));
  }
  job.lines.lead = lengths.perhaps("--lead", arguments.lead).value_or(Nanometres{});
  if (job.lines.lead.count > 0 && (job.lines.kerf.count == 0 || job.lines.side == ProfileSide::on)) {
    lengths.refuse("--lead: expected --kerf above 0 and not --side on; a lead-in lies beside the part");
  }
  job.join = lengths.any("--join", arguments.join);
  if (job.join.count < 0) lengths.refuse("--join: expected a length of 0 or more");
  const Nanometres feed = job.drawing.program.feed;
  job.cut.beam = {s_of(arguments.power, arguments.max_s), feed};
  job.cut.passes = arguments.passes;
  job.cut.step = lengths.perhaps("--step", arguments.step).value_or(Nanometres{});
  job.cut.focus = job.program.focus.value_or(Nanometres{});
  if (job.cut.step.count > 0 && !job.program.focus)
    lengths.refuse("--step: expected also --focus, the Z of the first pass");
  job.score = {s_of(arguments.score_power, arguments.max_s),
               lengths.perhaps("--score-feed", arguments.score_feed).value_or(feed)};
  const auto check_power = [&](const char* option, double percent) {
    if (s_of(percent, arguments.max_s) > 0) return;
    lengths.refuse(
        fmt::format("{}: expected more than {:g} %, which is S0 of --max-s {}", option, percent, arguments.max_s));
  };
  check_power("--power", arguments.power);
  check_power("--score-power", arguments.score_power);
  refuse_wrong_colours(arguments.score_colors, lengths, "--score-color");
}

void take_picture(const CamLaserArguments& arguments, LaserJob& job, LengthArguments& lengths) {
  job.width = to_mm(lengths.above_0("--width", arguments.width));
  constexpr Mm widest(4000);
  if (job.width > widest) lengths.refuse("--width: expected at most 4 m");
  RasterMoves& raster = job.raster;
  raster.line = lengths.above_0("--line-distance", arguments.line_distance);
  if (raster.line < finest_line || raster.line > widest_line) {
    lengths.refuse(fmt::format("--line-distance: expected 0.01 to 10 mm, found '{}'", arguments.line_distance));
  }
  raster.is_along_y = arguments.scan == "y";
  raster.is_one_way = arguments.one_way;
  raster.feed = job.drawing.program.feed;
  raster.overscan = arguments.overscan.empty() ? overscan_for(raster.feed, job.program.acceleration)
                                               : lengths.any("--overscan", arguments.overscan);
  constexpr Nanometres longest{1'000'000'000};
  if (raster.overscan.count < 0 || raster.overscan > longest) {
    lengths.refuse(
        fmt::format("overscan: expected 0 to 1000 mm, found {:.4g} mm; a lower --feed, a higher --acceleration "
                    "or another --overscan",
                    to_mm(raster.overscan).value()));
  }
  ToneOptions& tones = job.tones;
  tones.mode = arguments.mode == "dither"      ? ToneMode::dither
               : arguments.mode == "ordered"   ? ToneMode::ordered
               : arguments.mode == "threshold" ? ToneMode::threshold
                                               : ToneMode::grey;
  tones.threshold = arguments.threshold;
  tones.gamma = arguments.gamma;
  tones.invert = arguments.invert;
  tones.mirror_x = job.drawing.mirror.turned == Mirror::Turned::x;
  tones.mirror_y = job.drawing.mirror.turned == Mirror::Turned::y;
  tones.least_percent = arguments.least_power;
  tones.most_percent = arguments.power;
  tones.most_s = arguments.max_s;
  if (tones.least_percent > tones.most_percent) lengths.refuse("--least-power: expected at most --power");
}

LaserGrid laser_grid_of(const CamLaserArguments& arguments, const LaserJob& job, LengthArguments& lengths) {
  LaserGrid grid;
  constexpr std::size_t most = 20;
  const auto size = pair_of<std::size_t>(arguments.grid, 'x');
  if (!size || size->first < 1 || size->second < 1 || size->first > most || size->second > most) {
    lengths.refuse(
        fmt::format("--grid: expected COLUMNSxROWS, from 1x1 to {0}x{0}, found '{1}'", most, arguments.grid));
  } else {
    grid.columns = size->first;
    grid.rows = size->second;
  }
  const auto power = pair_of<double>(arguments.grid_power, ',');
  if (!power || !(power->first > 0 && power->first <= power->second && power->second <= 100)) {
    lengths.refuse(
        fmt::format("--grid-power: expected LEAST,MOST in percent, e.g. 20,100, found '{}'", arguments.grid_power));
  } else {
    grid.least_percent = power->first;
    grid.most_percent = power->second;
  }
  const std::vector<Nanometres> feeds = lengths.list("--grid-feed", arguments.grid_feed);
  constexpr Nanometres slowest{1'000'000};
  if (feeds.size() != 2 || feeds[0] < slowest || feeds[0] > feeds[1]) {
    lengths.refuse(
        fmt::format("--grid-feed: expected LEAST,MOST of at least 1 mm/min, found '{}'", arguments.grid_feed));
  } else {
    grid.least_feed = feeds[0];
    grid.most_feed = feeds[1];
  }
  grid.size = lengths.above_0("--cell", arguments.cell);
  constexpr Nanometres smallest{2'000'000};
  constexpr Nanometres largest{100'000'000};
  if (grid.size < smallest || grid.size > largest) {
    lengths.refuse(fmt::format("--cell: expected 2 to 100 mm, found '{}'", arguments.cell));
  }
  grid.line = job.raster.line;
  grid.is_filled = !arguments.grid_outlines;
  grid.passes = job.cut.passes;
  grid.label = job.score;
  return grid;
}

}  // namespace

LaserJob laser_job_of(const CamLaserArguments& arguments, LengthArguments& lengths) {
  LaserJob job{.drawing = mill_job_of(arguments, "passo cam laser", lengths, "work")};
  job.program = laser_program_of(arguments, job.drawing, lengths);
  // Z0 is of no importance to a beam.
  for (std::string& remark : job.program.remarks) remark = remark.substr(0, remark.find(", Z0 the face"));
  if (!arguments.grid.empty()) {
    job.program.remarks = {"X0 Y0 is the lower left corner of the lower left square"};
  }
  job.lines.start = job.program.park;
  take_lines(arguments, job, lengths);
  take_picture(arguments, job, lengths);
  if (!arguments.grid.empty()) job.grid = laser_grid_of(arguments, job, lengths);
  return job;
}

}  // namespace passo
