#include "passo/activity/cut_forecast.hpp"

#include <algorithm>
#include <variant>

#include "mistake_sentences.hpp"
#include <fmt/format.h>

#include "passo/activity/nominal_time.hpp"

namespace passo {
namespace {

constexpr double mm_in_metre = 1000;

bool is_over(const CutAmount& cut, const LifeLeft& left) {
  return (left.length && cut.length > *left.length) || (left.time && cut.time > *left.time);
}

SentenceArguments arguments_of(std::int32_t tool, const CutAmount& cut, const LifeLeft& left) {
  const bool by_length = left.length && cut.length > *left.length;
  const auto words = [&](const CutAmount& amount) {
    return by_length ? fmt::format("{:.1f} m", std::max(0.0, amount.length.value() / mm_in_metre))
                     : fmt::format("{:.1f} min", std::max(0.0, amount.time.value() / seconds_per_minute));
  };
  const CutAmount rest{.length = left.length.value_or(Mm(0)), .time = left.time.value_or(Seconds(0))};
  return {{"tool", std::to_string(tool)}, {"cuts", words(cut)}, {"left", words(rest)}};
}

}  // namespace

void CutForecast::add(const PathItem& item) {
  const auto* const segment = std::get_if<Segment>(&item);
  const bool cuts = segment != nullptr && !segment->rapid;
  meter_.watch(item, cuts ? nominal_time_of(item, limits_) : Seconds(0));
  if (!cuts || left_.empty() || ends_at_.contains(meter_.tool())) return;
  const auto left = left_.find(meter_.tool());
  const auto cut = meter_.amounts().find(meter_.tool());
  if (left == left_.end() || cut == meter_.amounts().end()) return;
  if (is_over(cut->second, left->second)) ends_at_.emplace(meter_.tool(), segment->source.line);
}

void CutForecast::add_findings(const std::string& file, Diagnostics& findings) const {
  for (const auto& [tool, line] : ends_at_) {
    findings.add(
        {.severity = Severity::warning,
         .code = "tool.life-ends",
         .file = file,
         .place = {.line = line, .column = 0},
         .message = mistakes_say::life_ends.with(arguments_of(tool, meter_.amounts().at(tool), left_.at(tool))),
         .expected = mistakes_say::new_tool.with({{"tool", std::to_string(tool)}}),
         .text = ""});
  }
}

}  // namespace passo
