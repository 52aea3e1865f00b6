#include "passo/cam/wire_core.hpp"

#include <algorithm>
#include <utility>

#include "thin_line.hpp"
#include <fmt/format.h>

#include "passo/cam/edge_loops.hpp"
#include "passo/cam/region.hpp"

namespace passo {
namespace {

constexpr Nanometres core_chords{500};

// Removes points that are almost in line: an offset has corners with edges so short that their directions are
// meaningless.
DrawnRing without_tiny_edges(DrawnRing ring) {
  constexpr double least_nm = 2'000;
  // The profile from the point of greatest X around to the same point.
  const auto first = std::ranges::max_element(ring, {}, &DrawnPoint::x);
  std::rotate(ring.begin(), first, ring.end());
  return thinned_ring(ring, least_nm);
}

class CoreMaker {
 public:
  CoreMaker(const WireProfile& section, Diagnostics& diagnostics)
      : diagnostics_(diagnostics), foam_(filled({chords_of_path(section.points, true, core_chords)})) {}

  std::optional<WireProfile> make(const WireCore& core) {
    if (core.skin.count > 0) foam_ = grown(foam_, {-core.skin.count}, core_chords);
    if (foam_.rings.size() != 1) {
      refuse("wire.thick-skin",
             fmt::format("within a skin of {:.4g} mm the section {}", to_mm(core.skin).value(),
                         foam_.empty() ? "has no core" : "falls into pieces"),
             "a thinner --skin");
      return std::nullopt;
    }
    for (const WireSpar& spar : core.spars) {
      if (!cut(spar)) return std::nullopt;
    }
    WireProfile profile;
    for (const DrawnPoint& at : without_tiny_edges(foam_.rings.front())) profile.points.push_back({at, 0});
    return profile;
  }

 private:
  void refuse(const char* code, std::string message, std::string expected) {
    diagnostics_.add({.code = code,
                      .file = "",
                      .place = {},
                      .message = std::move(message),
                      .expected = std::move(expected),
                      .text = ""});
  }
  bool cut(const WireSpar& spar);

  Diagnostics& diagnostics_;
  Region foam_;
};

bool CoreMaker::cut(const WireSpar& spar) {
  const DrawnBox whole = box_of(foam_.rings.front());
  constexpr Nanometres beyond{1'000'000};
  // The surface at the middle of the slot: the ends of a thin strip.
  constexpr Nanometres thin{2'000};
  const Region strip = common(
      foam_, filled({rectangle({{spar.at - thin, whole.least.y - beyond}, {spar.at + thin, whole.most.y + beyond}})}));
  const std::optional<DrawnBox> at = bounds(strip);
  const double x = to_mm(spar.at).value();
  if (!at) {
    refuse("wire.no-spar", fmt::format("at X{:.6g} mm there is no core for a spar", x),
           fmt::format("X from {:.6g} to {:.6g} mm", to_mm(whole.least.x).value(), to_mm(whole.most.x).value()));
    return false;
  }
  const Nanometres left{spar.at.count - spar.width.count / 2};
  const Nanometres right = left + spar.width;
  const DrawnBox slot = spar.is_below ? DrawnBox{{left, whole.least.y - beyond}, {right, at->least.y + spar.depth}}
                                      : DrawnBox{{left, at->most.y - spar.depth}, {right, whole.most.y + beyond}};
  const Region rest = subtracted(foam_, filled({rectangle(slot)}));
  if (rest.rings.size() != 1) {
    refuse("wire.no-spar",
           fmt::format("a slot {:.4g} mm deep at X{:.6g} mm divides the core, which is {:.4g} mm thick there",
                       to_mm(spar.depth).value(), x, to_mm(at->most.y - at->least.y).value()),
           "a smaller depth in --spar");
    return false;
  }
  foam_ = rest;
  return true;
}

}  // namespace

std::optional<WireProfile> wire_core(const WireProfile& section, const WireCore& core, Diagnostics& diagnostics) {
  return CoreMaker(section, diagnostics).make(core);
}

}  // namespace passo
