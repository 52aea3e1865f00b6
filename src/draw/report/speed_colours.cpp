#include "speed_colours.hpp"

#include <algorithm>

namespace passo {
namespace {

// Every tenth of the colour map, from 0.8 down to 0.1.
constexpr std::array<std::array<int, 3>, 8> viridis = {{{122, 209, 81},
                                                        {68, 191, 112},
                                                        {34, 168, 132},
                                                        {33, 145, 140},
                                                        {42, 120, 142},
                                                        {53, 95, 141},
                                                        {65, 68, 135},
                                                        {72, 36, 117}}};

}  // namespace

std::size_t SpeedColours::class_of(double speed) const {
  if (!(fastest_ > 0)) return classes - 1;
  const double share = std::clamp(speed / fastest_, 0.0, 1.0);
  return std::min(classes - 1, static_cast<std::size_t>(share * classes));
}

Colour SpeedColours::at(double share) {
  const double place = std::clamp(share, 0.0, 1.0) * (viridis.size() - 1);
  const std::size_t index = std::min(viridis.size() - 2, static_cast<std::size_t>(place));
  const double part = place - static_cast<double>(index);
  const auto mixed = [&](std::size_t channel) {
    return ((1 - part) * viridis[index][channel] + part * viridis[index + 1][channel]) / 255;
  };
  return {mixed(0), mixed(1), mixed(2)};
}

}  // namespace passo
