// ServedStudies: runs `passo check` and `passo tune` for the API in a separate process (background_process.hpp).
#pragma once

#include <string>

#include "background_process.hpp"

#include "passo/api/studies.hpp"

namespace passo {

class ServedStudies final : public Studies {
 public:
  bool begin(const StudyOrder& order) override;
  const StudyResult& result() override;
  std::string loads() const override;
  std::string picture() const override;

 private:
  TemporaryFolder folder_;
  BackgroundProcess process_;
  StudyResult result_;
};

}  // namespace passo
