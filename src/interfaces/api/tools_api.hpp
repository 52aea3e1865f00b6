// ToolsApi: the tools of the machine: their names and limits from the tool library, their lengths and pockets from the
// tool table, and what they have cut. Private to api/.
#pragma once

#include "api_call.hpp"
#include "api_shared.hpp"

namespace passo {

class ToolsApi {
 public:
  // Must outlive this object.
  explicit ToolsApi(const ApiShared& shared) : shared_(shared) {}

  WebAnswer list(const ApiCall& call);
  WebAnswer replace(const ApiCall& call);

 private:
  Json tools() const;

  const ApiShared& shared_;
};

}  // namespace passo
