// CamApi: programs made of drawings and pictures. Private to api/.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "api_call.hpp"
#include "api_shared.hpp"
#include "job_runner.hpp"

namespace passo {

class CamApi {
 public:
  // Both outlive this.
  CamApi(const ApiShared& shared, const JobRunner& jobs) : shared_(shared), jobs_(jobs) {}

  WebAnswer get(const ApiCall& call);
  WebAnswer operations(const ApiCall& call);
  WebAnswer begin(const ApiCall& call);
  WebAnswer keep_file(const ApiCall& call);
  WebAnswer clear_files(const ApiCall& call);
  WebAnswer picture(const ApiCall& call);
  WebAnswer page(const ApiCall& call);

  // Programs that are made go to the others. What is made again of the same drawing takes the place of what was made
  // before, also where a board has other steps now.
  void poll();

 private:
  WebAnswer state_answer(unsigned status = 200);

  const ApiShared& shared_;
  const JobRunner& jobs_;
  std::string making_;               // what is made of what, as "board/a.gbr"; empty: no order runs
  std::vector<std::uint64_t> made_;  // the programs of the last order
  std::map<std::string, std::vector<std::uint64_t>, std::less<>> made_of_;
};

}  // namespace passo
