// SettingsApi: the settings of a Grbl board: shown, written, saved, compared and restored. Private to api/.
#pragma once

#include "api_call.hpp"
#include "api_shared.hpp"
#include "job_runner.hpp"

namespace passo {

class SettingsApi {
 public:
  // Both must outlive this object.
  SettingsApi(const ApiShared& shared, const JobRunner& jobs) : shared_(shared), jobs_(jobs) {}

  WebAnswer get(const ApiCall& call);
  WebAnswer file(const ApiCall& call);
  WebAnswer begin(const ApiCall& call);

 private:
  BoardSettings& settings() const { return *shared_.options.settings; }
  WebAnswer state_answer(unsigned status) const;

  const ApiShared& shared_;
  const JobRunner& jobs_;
};

}  // namespace passo
