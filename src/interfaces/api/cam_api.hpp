// CamApi: generates programs from drawings and pictures. Private to api/.
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
  // Both must outlive this object.
  CamApi(const ApiShared& shared, const JobRunner& jobs) : shared_(shared), jobs_(jobs) {}

  WebAnswer get(const ApiCall& call);
  WebAnswer operations(const ApiCall& call);
  WebAnswer begin(const ApiCall& call);
  WebAnswer keep_file(const ApiCall& call);
  WebAnswer clear_files(const ApiCall& call);
  WebAnswer picture(const ApiCall& call);
  WebAnswer page(const ApiCall& call);
  WebAnswer shapes(const ApiCall& call);
  WebAnswer job_file(const ApiCall& call);
  WebAnswer edit_job_file(const ApiCall& call);
  WebAnswer tools(const ApiCall& call);

  // Adds generated programs to the program store. A program generated again from the same drawing replaces the previous
  // one, even if a board now has other steps.
  void poll();

 private:
  WebAnswer draft_answer(const std::string& name) const;
  WebAnswer state_answer(unsigned status = 200);

  const ApiShared& shared_;
  const JobRunner& jobs_;
  std::string making_;               // the current operation and its input, e.g. "board/a.gbr"; empty: no order is
                                     // running
  std::vector<std::uint64_t> made_;  // the programs of the last order
  std::map<std::string, std::vector<std::uint64_t>, std::less<>> made_of_;
};

}  // namespace passo
