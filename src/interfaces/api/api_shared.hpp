// ApiShared: the data shared by all parts of the API. Private to api/.
#pragma once

#include <optional>

#include "kept_offsets.hpp"

#include "passo/api/api_options.hpp"
#include "passo/api/camera.hpp"
#include "passo/api/machine_control.hpp"
#include "passo/api/program_store.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/session/machine_session.hpp"

namespace passo {

struct ApiShared {
  const MachineDescription& machine;
  MachineSession& session;
  MachineControl& owner;
  const ApiOptions& options;
  ProgramStore& programs;
  KeptOffsets& offsets;
  std::optional<MachineCamera> camera = {};  // empty: the machine has none

  double wall_time() const { return options.wall_time ? options.wall_time() : 0; }
};

}  // namespace passo
