// Programs for the solder mask and the stencil of a board, which `passo cam board` writes: the openings of the mask are
// cleared, those of the stencil are cut out of a film.
#pragma once

#include <string>

#include "cam_commands.hpp"

namespace passo {

struct CamOpeningArguments : CamMillArguments {
  std::string tool;
  std::string depth;
};

// `given`: its layer's face has the openings; they are milled within its board.
int cam_mask(const CamOpeningArguments& arguments, const WorkProgress& progress, const CamSources* given,
             CamMade* made);
int cam_stencil(const CamOpeningArguments& arguments, const WorkProgress& progress, const CamSources* given,
                CamMade* made);

}  // namespace passo
