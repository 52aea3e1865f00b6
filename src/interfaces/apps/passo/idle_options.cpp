#include "idle_options.hpp"

#include <initializer_list>
#include <utility>

#include "program_input.hpp"

#include "passo/diagnostics/file_bytes.hpp"

namespace passo {
namespace {

// Options that have an effect only if `works`.
struct OptionGroup {
  bool works = false;
  const char* why;  // "it works only with clear"
  std::initializer_list<const char*> options;
};

std::vector<IdleOption> idle_of(std::initializer_list<OptionGroup> groups, const IsGiven& is_given) {
  std::vector<IdleOption> idle;
  for (const OptionGroup& group : groups) {
    if (group.works) continue;
    for (const char* const option : group.options) {
      if (is_given(option)) idle.push_back({option + 2, group.why});
    }
  }
  return idle;
}

constexpr const char* finish_only = "it works only with finish-pass";

}  // namespace

std::vector<IdleOption> idle_options_of(const CamProfileArguments& arguments, const IsGiven& is_given) {
  const bool has_chamfer = !arguments.chamfer.empty();
  return idle_of({{arguments.finish_pass, finish_only, {"--finish-feed", "--spring-passes"}},
                  {has_chamfer, "it works only with chamfer", {"--angle", "--tip"}},
                  {!has_chamfer,
                   "a chamfer follows the contours once, as deep as its width requires",
                   {"--depth", "--step", "--ramp", "--tabs"}}},
                 is_given);
}

std::vector<IdleOption> idle_options_of(const CamPocketArguments& arguments, const IsGiven& is_given) {
  const bool finishes = arguments.finish_pass || is_given("--floor-allowance");
  return idle_of({{finishes, "it works only with finish-pass or floor-allowance", {"--finish-feed"}},
                  {arguments.finish_pass, finish_only, {"--spring-passes", "--lead"}}},
                 is_given);
}

std::vector<IdleOption> idle_options_of(const CamEngraveArguments& arguments, const IsGiven& is_given) {
  return idle_of({{!arguments.text.empty(),
                   "it works only with text",
                   {"--font", "--height", "--text-align", "--around", "--arc", "--turn", "--line-space"}},
                  {arguments.trace, "it works only with trace", {"--threshold", "--invert", "--turdsize", "--width"}},
                  {!arguments.clear.empty() || !arguments.inlay.empty(), "it works only with clear", {"--clear-step"}},
                  {!arguments.inlay.empty(), "it works only with inlay", {"--inlay-depth", "--glue-gap"}},
                  {arguments.inlay == "plug", "it works only with inlay plug", {"--saw-gap", "--margin"}}},
                 is_given);
}

std::vector<IdleOption> idle_options_of(const CamDrillArguments& arguments, const IsGiven& is_given) {
  return idle_of({{!arguments.mill.empty(), "it works only with mill", {"--mill-step", "--mill-feed"}}}, is_given);
}

std::vector<IdleOption> idle_options_of(const CamReliefArguments& arguments, const IsGiven& is_given) {
  return idle_of({{!arguments.rough.empty(),
                   "it works only with rough",
                   {"--rough-way", "--rough-step", "--rough-down", "--rough-stock", "--rough-feed", "--rough-removal"}},
                  {!arguments.rest.empty(),
                   "it works only with rest",
                   {"--rest-step", "--rest-least", "--rest-feed", "--rest-removal"}}},
                 is_given);
}

void show_idle_options(const std::vector<IdleOption>& idle) {
  Diagnostics findings;
  for (const IdleOption& option : idle) {
    Diagnostic finding = of_file("option.no-effect", "--" + option.name, "it has no effect: " + option.why, "");
    finding.severity = Severity::warning;
    findings.add(std::move(finding));
  }
  show(findings);
}

}  // namespace passo
