#include "traced_picture.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <optional>

#include "background_process.hpp"
#include <fmt/format.h>

#include "passo/cam/svg.hpp"
#include "passo/carve/level_picture.hpp"
#include "passo/confinement/confined_run.hpp"
#include "passo/confinement/confinement.hpp"
#include "passo/confinement/temporary_folder.hpp"
#include "passo/diagnostics/file_bytes.hpp"

namespace passo {
namespace {

constexpr const char* bitmap_file = "picture.pbm";
constexpr const char* outline_file = "picture.svg";
constexpr int white = 65'535;

// A picture with one bit for each pixel (PBM). A dark pixel is 1.
std::string bitmap_of(const LevelPicture& picture, const PictureTraceOptions& options) {
  std::string bitmap = fmt::format("P4\n{} {}\n", picture.columns, picture.rows);
  const double threshold = options.threshold * white;
  const std::size_t bytes = (picture.columns + 7) / 8;
  for (std::size_t row = 0; row < picture.rows; ++row) {
    std::string bits(bytes, '\0');
    for (std::size_t column = 0; column < picture.columns; ++column) {
      const bool is_dark = (picture.levels[row * picture.columns + column] < threshold) != options.invert;
      if (is_dark) bits[column / 8] = static_cast<char>(bits[column / 8] | (0x80 >> (column % 8)));
    }
    bitmap += bits;
  }
  return bitmap;
}

class PictureTracer {
 public:
  PictureTracer(const std::string& path, const PictureTraceOptions& options, Diagnostics& diagnostics)
      : path_(path), options_(options), diagnostics_(diagnostics) {}

  Drawing trace() {
    const std::optional<std::string> bitmap = read_bitmap();
    if (!bitmap) return {};
    const std::optional<std::string> outlines = run_potrace(*bitmap);
    if (!outlines) return {};
    Drawing drawing = read_svg(path_, *outlines, {}, diagnostics_);
    if (!diagnostics_.any_error() && drawing.paths.empty()) {
      refuse("trace.nothing", "the picture has no dark area", "another --threshold, --invert, or a smaller --turdsize");
    }
    return drawing;
  }

 private:
  void refuse(const char* code, std::string message, std::string expected) {
    diagnostics_.add(of_file(code, path_, std::move(message), std::move(expected)));
  }
  std::optional<std::string> read_bitmap();
  std::optional<std::string> run_potrace(const std::string& bitmap);

  const std::string& path_;
  const PictureTraceOptions& options_;
  Diagnostics& diagnostics_;
};

std::optional<std::string> PictureTracer::read_bitmap() {
  const auto bytes = read_bytes(path_, {.area = "picture", .expected = "a picture (PNG, JPEG or TIFF)"}, diagnostics_);
  if (!bytes) return std::nullopt;
  if (!is_level_picture(*bytes)) {
    refuse("trace.no-picture", "this is no picture", "a picture (PNG, JPEG or TIFF); --trace is not for drawings");
    return std::nullopt;
  }
  const LevelPicture picture = read_picture_on_white(path_, *bytes, diagnostics_);
  if (picture.columns == 0) return std::nullopt;
  if (picture.columns * picture.rows > most_traced_pixels) {
    refuse("trace.too-large", fmt::format("the picture has {} x {} pixels", picture.columns, picture.rows),
           fmt::format("at most {} million pixels", most_traced_pixels / (1024 * 1024)));
    return std::nullopt;
  }
  return bitmap_of(picture, options_);
}

std::optional<std::string> PictureTracer::run_potrace(const std::string& bitmap) {
  TemporaryFolder folder;
  const auto failed = [&](std::string why) {
    refuse("trace.failed", "potrace: " + std::move(why), "outlines of the picture");
    return std::nullopt;
  };
  if (!folder.make() || !write_content(folder.path(bitmap_file), bitmap)) {
    return failed("a temporary folder cannot be written");
  }
  ConfinedProgram potrace{
      .folder = folder.name(),
      .words = {"potrace", "--svg", "--flat", "--turdsize", std::to_string(options_.turdsize), "--width",
                fmt::format("{:.6f}mm", options_.width.value()), "--output", outline_file, bitmap_file},
      .input = "",
      .readable = system_folders(),
      .unconfined = !check_confinement(),
      .limits = {.processor_seconds = 60,
                 .total_seconds = 120,
                 .memory = std::uint64_t{2} << 30,
                 .output = std::uint64_t{128} << 20}};
  const Result<ConfinedRun, std::string> run = run_confined(potrace);
  if (!run) return failed(run.error());
  if (run->end == ConfinedRun::End::not_started && run->code == ENOENT) {
    refuse("trace.no-potrace", "potrace: not found; apt install potrace", "the program potrace, which traces pictures");
    return std::nullopt;
  }
  if (const std::string end = describe_end(*run, potrace.limits); !end.empty()) {
    constexpr std::size_t longest = 200;
    return failed(end + (run->messages.empty() ? "" : ": " + run->messages.substr(0, longest)));
  }
  std::optional<std::string> outlines = content_of(folder.path(outline_file));
  return outlines->empty() ? failed("it wrote no outlines") : std::move(outlines);
}

}  // namespace

Drawing trace_picture(const std::string& path, const PictureTraceOptions& options, Diagnostics& diagnostics) {
  return PictureTracer(path, options, diagnostics).trace();
}

}  // namespace passo
