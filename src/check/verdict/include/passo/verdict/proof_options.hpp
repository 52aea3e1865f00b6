// The limits of a machine in the form that the verification of the motion uses (passo/proof).
#pragma once

#include "passo/machine_file/machine_description.hpp"
#include "passo/proof/motion_proof.hpp"

namespace passo {

ProofOptions proof_options(const MachineDescription& machine);

}  // namespace passo
