#include "passo/report/picture.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "inner_types.hpp"
#include "png_pixels.hpp"
#include "program_content.hpp"
#include <fmt/format.h>

#include "passo/cutting/simulation.hpp"
#include "passo/cutting/stock_job.hpp"
#include "passo/judge/judgement.hpp"
#include "passo/machine_file/machine_kind.hpp"
#include "passo/report/stock_picture.hpp"

namespace passo::v1 {
namespace {

constexpr int least_pixels = 200;
constexpr int most_pixels = 8000;

passo::PathColour colour_of(PathTint tint) {
  switch (tint) {
    case PathTint::depth: return passo::PathColour::depth;
    case PathTint::tool: return passo::PathColour::tool;
    case PathTint::torque: return passo::PathColour::margin;
    case PathTint::speed: break;
  }
  return passo::PathColour::speed;
}

std::optional<Finding> size_error_of(const PictureOptions& options) {
  if (std::min(options.width, options.height) >= least_pixels &&
      std::max(options.width, options.height) <= most_pixels) {
    return std::nullopt;
  }
  return error_of("picture.size", "", 0, fmt::format("a picture of {} x {} pixels", options.width, options.height),
                  fmt::format("{} to {} pixels", least_pixels, most_pixels));
}

passo::PictureOptions inner_options_of(const PictureOptions& options) {
  return {.format = passo::PictureFormat::png,
          .program = options.title,
          .machine = {},
          .colour = colour_of(options.tint),
          .rapids = options.rapids,
          .width = options.width,
          .height = options.height};
}

template <class Draw>
Outcome<Picture> drawn(std::vector<Finding> findings, const Draw& draw) {
  std::string bytes;
  passo::OutputFile file = passo::OutputFile::into(bytes);
  passo::Status<passo::OutputError> done = draw(file);
  if (done) done = file.commit();
  Picture picture = done ? pixels_of(bytes) : Picture{};
  if (picture.rgb.empty()) {
    findings.push_back(
        error_of("picture.failed", "", 0, done ? "the picture cannot be drawn" : done.error().message, ""));
    return Outcome<Picture>(std::move(findings));
  }
  return {std::move(picture), std::move(findings)};
}

}  // namespace

Outcome<Picture> draw_toolpath(const Program& program, const Machine& machine, const PictureOptions& options,
                               const ReadOptions& read) {
  if (const auto error = size_error_of(options)) return Outcome<Picture>({*error});
  const passo::MachineDescription& description = machine.content().description;
  passo::Diagnostics diagnostics;
  const passo::InterpreterOptions inner_read = interpreter_options_of(read, diagnostics);
  passo::ProgramCheck check;
  if (!diagnostics.any_error()) {
    check = passo::check_program(program.content().reader.again(), description, inner_read, diagnostics);
  }
  if (!check.good) return Outcome<Picture>(findings_of(diagnostics));
  passo::PathRecorder path;
  (void)passo::judge(program.content().reader.again(), description, inner_read, check, {.path = &path});
  passo::PictureOptions inner_options = inner_options_of(options);
  inner_options.machine = description.name;
  inner_options.is_lathe = passo::is_lathe(description);
  return drawn(findings_of(diagnostics),
               [&](passo::OutputFile& file) { return passo::draw_picture(path, inner_options, file); });
}

Outcome<Picture> draw_stock(const Stock& stock, const PictureOptions& options) {
  if (const auto error = size_error_of(options)) return Outcome<Picture>({*error});
  const double right = stock.left_mm + static_cast<double>(stock.columns) * stock.cell_mm;
  const double back = stock.front_mm + static_cast<double>(stock.rows) * stock.cell_mm;
  auto field = passo::HeightField::create(
      {{stock.left_mm, stock.front_mm, stock.bottom_mm}, {right, back, stock.top_mm}}, passo::Mm(stock.cell_mm));
  if (!field) return Outcome<Picture>({error_of("picture.stock", "", 0, field.error().message, "")});
  if (stock.below_top_mm.size() != stock.columns * stock.rows || field->columns() < stock.columns ||
      field->rows() < stock.rows) {
    return Outcome<Picture>(
        {error_of("picture.stock", "", 0,
                  fmt::format("{} heights for {} x {} cells", stock.below_top_mm.size(), stock.columns, stock.rows),
                  "a height for each cell")});
  }
  for (std::size_t row = 0; row < stock.rows; ++row) {
    std::copy_n(stock.below_top_mm.begin() + static_cast<std::ptrdiff_t>(row * stock.columns), stock.columns,
                field->below_top(row));
  }
  return drawn({}, [&](passo::OutputFile& file) {
    return passo::draw_stock({.field = *field}, inner_options_of(options), file);
  });
}

}  // namespace passo::v1
