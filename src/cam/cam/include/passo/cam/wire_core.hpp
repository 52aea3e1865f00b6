// wire_core: makes the foam core of a wing from its section: smaller by the skin that is glued on, with slots for
// spars.
//
// A slot is a rectangle, open upwards or downwards. Its depth is measured from the surface of the core at the middle of
// the slot. The wire cuts it on its way around the section, so it must be wider than the kerf.
#pragma once

#include <optional>
#include <vector>

#include "passo/cam/wire_cut.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct WireSpar {
  Nanometres at{};        // X of its middle
  Nanometres width{};     // above 0
  Nanometres depth{};     // above 0
  bool is_below = false;  // whether it is open downwards
};

struct WireCore {
  Nanometres skin{};  // 0 or more
  std::vector<WireSpar> spars = {};
};

// The profile must be closed. Reports errors "wire.thick-skin" and "wire.no-spar" in `diagnostics`, and then returns
// nothing.
std::optional<WireProfile> wire_core(const WireProfile& section, const WireCore& core, Diagnostics& diagnostics);

}  // namespace passo
