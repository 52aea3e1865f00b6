#include "part_job_tool_use.hpp"

#include <algorithm>
#include <optional>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "passo/operations/length_text.hpp"
#include "passo/tooling/tool_warnings.hpp"
#include "passo/tooling/work_material.hpp"

namespace passo {
namespace {

double number_of(const PartJob& job, const PartOperation& operation, std::string_view option) {
  const std::string text = option_text(operation, option);
  const Result<Mm, std::string> length = parse_length("", text, *mm_of_unit(job.units));
  return length ? length->value() : 0;
}

// How the tool is used, as seen in the trial.
ToolUse use_of(const PartJob& job, const PartOperation& operation, const TriedOperation& tried) {
  ToolUse use;
  use.depth = Mm(tried.depth_mm);
  use.depth_per_pass = Mm(tried.pass_mm);
  use.plunges = tried.plunges && operation.kind != PartKind::drill;
  std::visit([&](const auto& arguments) { use.rpm = arguments.spindle; }, operation.arguments);
  const bool mills =
      operation.kind == PartKind::face || operation.kind == PartKind::pocket || operation.kind == PartKind::profile;
  if (!mills) return use;
  constexpr double seconds_per_minute = 60;
  use.feed = MmPerSecond(number_of(job, operation, "feed") / seconds_per_minute);
  if (const auto* pocket = std::get_if<CamPocketArguments>(&operation.arguments)) {
    const double diameter = job.tools.at(operation.tool).tool.diameter.value();
    if (pocket->engagement <= 0) use.step_over = Mm(diameter * pocket->step_over / 100);
  }
  return use;
}

// Neither the file nor a chip load gives a feed rate.
std::string no_feed_words(const PartJob& job) {
  const std::string material = job.stock ? job.stock->material : "";
  const auto names = work_material_names();
  return fmt::format(
      "the feed rate is the default, because the tool has none and {}; known materials: {}",
      material.empty() ? "the stock has no material" : fmt::format("there are no chip loads for '{}'", material),
      fmt::join(names, ", "));
}

}  // namespace

std::string option_text(PartOperation operation, std::string_view name) {
  const std::vector<CamOption> options = cam_options_of(operation);
  const auto found = std::ranges::find(options, name, &CamOption::name);
  return found == options.end() ? "" : text_of(*found);
}

std::vector<std::string> tool_notes(const PartJob& job, const PartOperation& operation, const TriedOperation& tried) {
  const auto material = job.stock ? job.stock->known_material : std::nullopt;
  const PartTool& tool = job.tools.at(operation.tool);
  std::vector<std::string> notes;
  if (!tool.feeds_from.empty() && !operation.has("feed")) notes.push_back(tool.feeds_from);
  if (!tool.feed && !operation.has("feed") && operation.kind != PartKind::drill) notes.push_back(no_feed_words(job));
  for (const ToolWarning& warning : warnings_of(tool.tool, use_of(job, operation, tried), material)) {
    notes.push_back(fmt::format("warning: {}: {} [{}]", warning.message, warning.advice, warning.code));
  }
  return notes;
}

}  // namespace passo
