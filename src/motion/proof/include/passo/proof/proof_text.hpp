// A MotionProof as readable text, and as JSON.
//
// Both are the same from run to run. Keys of the JSON may be added but not changed. A missing limit is null.
#pragma once

#include <string>

#include "passo/proof/motion_proof.hpp"

namespace passo {

std::string to_text(const MotionProof& proof);
std::string to_json(const MotionProof& proof);

}  // namespace passo
