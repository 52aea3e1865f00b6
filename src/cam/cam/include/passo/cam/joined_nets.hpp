// find_joined_nets: finds the nets of a layer that are still connected to each other after isolation milling.
//
// A net is an island of copper with a pad, a hole or a name; islands with the same name are one net. Other islands,
// such as text, do not count, but they can connect two nets. If nothing is known about a layer's nets, each island is
// a net.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "passo/cam/board_layer.hpp"
#include "passo/cam/isolation.hpp"
#include "passo/cam/isolation_proof.hpp"

namespace passo {

struct JoinedNets {
  std::size_t nets = 0;
  std::size_t joined = 0;               // number of nets that are connected to another one
  std::size_t groups = 0;               // number of connected pieces that they form
  std::size_t others = 0;               // number of other islands that are connected to something
  std::vector<CopperGap> gaps = {};     // where islands of these pieces are joined, the narrowest first; they link all
                                        // islands of a piece
  std::vector<std::string> names = {};  // of each island; empty: unknown
};

// `known`: places on the copper. `finest`: the width of the finest cutter.
JoinedNets find_joined_nets(const Region& copper, const std::vector<NetPlace>& known, const MillPlan& plan,
                            const IsolationProof& proof, Nanometres finest);

}  // namespace passo
