// Options that have no effect, because they need another one: --spring-passes without --finish-pass. Each operation
// has a few such groups; a warning names the option that is missing or in the way.
#pragma once

#include <string>
#include <vector>

#include "cam_tools.hpp"

#include "passo/operations/cam_arguments.hpp"

namespace passo {

struct IdleOption {
  std::string name;  // "spring-passes"
  std::string why;   // "it works only with finish-pass"
};

// The options that are given, but have no effect.
std::vector<IdleOption> idle_options_of(const CamProfileArguments& arguments, const IsGiven& is_given);
std::vector<IdleOption> idle_options_of(const CamPocketArguments& arguments, const IsGiven& is_given);
std::vector<IdleOption> idle_options_of(const CamEngraveArguments& arguments, const IsGiven& is_given);
std::vector<IdleOption> idle_options_of(const CamDrillArguments& arguments, const IsGiven& is_given);
std::vector<IdleOption> idle_options_of(const CamReliefArguments& arguments, const IsGiven& is_given);

// Other operations have none.
template <class Arguments>
std::vector<IdleOption> idle_options_of(const Arguments& /*arguments*/, const IsGiven& /*is_given*/) {
  return {};
}

// Shows a warning "option.no-effect" for each of them.
void show_idle_options(const std::vector<IdleOption>& idle);

}  // namespace passo
