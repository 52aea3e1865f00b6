// What a MotionProof says, as a person reads it and as data.
//
// Both are the same from run to run. Keys of the JSON are added to, not changed; a limit that is not there is null.
#pragma once

#include <string>

#include "passo/proof/motion_proof.hpp"

namespace passo {

std::string to_text(const MotionProof& proof);
std::string to_json(const MotionProof& proof);

}  // namespace passo
