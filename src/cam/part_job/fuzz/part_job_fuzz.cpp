// Any bytes as a job file (TOML): either it is refused, with places inside its lines, or every operation has a tool and
// the options of its command, and each has one place in the order. Then the bytes as the program of an operation.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "kit/require.hpp"

#include "passo/part_job/joined_program.hpp"
#include "passo/part_job/operation_order.hpp"
#include "passo/part_job/part_job.hpp"
#include "passo/toml/fit_for_parser.hpp"
#include "passo/toml/toml_text.hpp"

namespace passo {
namespace {

using test::require;

void check_order(const PartJob& job) {
  const std::vector<OrderedOperation> order = order_operations(job);
  std::vector<bool> seen(job.operations.size());
  require(order.size() == seen.size(), "an operation is lost");
  for (const OrderedOperation& ordered : order) {
    require(ordered.index < seen.size() && !seen[ordered.index], "an operation twice");
    seen[ordered.index] = true;
  }
  require(tool_changes(job, order) <= 2 * order.size(), "too many changes");
}

void check_good(const PartJob& job) {
  require(!job.operations.empty() && job.operations.size() <= most_part_operations, "no operation, or too many");
  for (const PartOperation& operation : job.operations) {
    require(job.tools.contains(operation.tool), "an operation without a tool");
    require(operation.first_tool == 0 || job.tools.contains(operation.first_tool), "a second tool that is none");
    require(!operation.title.empty() && operation.place.line > 0, "an operation without title or place");
    PartOperation copy = operation;
    for (const PartKey& key : operation.keys) {
      const std::vector<CamOption> options = cam_options_of(copy);
      require(std::ranges::find(options, key.name, &CamOption::name) != options.end(), "a key that is no option");
    }
  }
  for (const PartClamp& clamp : job.clamps) {
    require(clamp.x[0] < clamp.x[1] && clamp.y[0] < clamp.y[1] && std::isfinite(clamp.height), "a clamp without room");
  }
  if (job.stock) require(job.stock->width > 0 && job.stock->length > 0 && job.stock->thickness > 0, "no stock");
  check_order(job);
}

void check_job(std::string_view text) {
  Diagnostics diagnostics;
  const auto job = parse_part_job(text, "fuzz.toml", diagnostics);
  require(job.has_value() == !diagnostics.any_error(), "refused without a word, or taken with an error");
  for (const Diagnostic& finding : diagnostics.all()) {
    require(finding.code.starts_with("job.") && !finding.message.empty(), "a finding without words");
    require(finding.place.column == 0 || finding.text.empty() || finding.place.column - 1 <= finding.text.size(),
            "a finding outside its line");
    static_cast<void>(render(finding, true));
  }
  if (job) check_good(*job);
}

// Edits of any text that the parser takes: each is refused, or leaves a text that can be edited again.
void check_edits(std::string_view text) {
  constexpr std::size_t longest = 20'000;
  Diagnostics diagnostics;
  const TomlReporter reporter(text, "fuzz.toml", diagnostics);
  if (text.size() > longest || !is_fit_for_parser(reporter)) return;
  auto toml = TomlText::read(std::string(text));
  if (!toml) return;
  const std::size_t seed = text.size();
  const auto may_refuse = [&](const Status<TomlTextError>& status) {
    require(status || !status.error().message.empty(), "refused without a word");
    require(TomlText::read(toml->text()).has_value(), "no TOML after an edit");
  };
  may_refuse(toml->set_words("operation.1.depth", "-1"));
  may_refuse(toml->set_words("job.x.y", "[[1, 2], [3, 4]]"));
  may_refuse(toml->move_table("operation", 1 + seed % 3, 1 + seed % 2));
  may_refuse(toml->copy_table("operation", 1 + seed % 2));
  may_refuse(toml->insert_table("operation", 1 + seed % 3, {{"kind", "\"drill\""}}));
  may_refuse(toml->remove("operation.1.depth"));
  may_refuse(toml->remove_table("operation", 1 + seed % 4));
}

void check_joined(std::string_view text) {
  JoinedProgram joined({std::string(text.substr(0, 80))});
  const JoinedOperation operation{.title = std::string(text.substr(0, 40)),
                                  .program = std::string(text),
                                  .tools = {{3, std::string(text)}},
                                  .park = "X0 Y0"};
  joined.add(operation);
  joined.add(operation);
  const std::vector<std::uint32_t> lines = joined.first_lines();
  const std::string program = joined.take();
  require(lines.size() == 2 && lines[0] <= lines[1], "lines of operations");
  require(lines[1] <= static_cast<std::size_t>(std::ranges::count(program, '\n')), "an operation after the end");
  require(program.ends_with("M2\n"), "no end");
}

}  // namespace
}  // namespace passo

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  passo::check_job(text);
  passo::check_edits(text);
  passo::check_joined(text);
  return 0;
}
