// FeedStages: the stages before and after a feed in the pipeline.
#pragma once

#include "passo/base/source.hpp"
#include "passo/drive/commanded_outputs.hpp"
#include "passo/drive/rewindable_path.hpp"
#include "passo/link/link.hpp"
#include "passo/stepgen/step_generator.hpp"
#include "passo/trajectory/planner.hpp"

namespace passo {

struct FeedStages {
  RewindablePath& path;
  Planner& planner;
  StepGenerator& generator;
  Source<BoardItem>& items;  // the generator's output, as seen by observers
  Link& link;
  CommandedOutputs& outputs;
};

}  // namespace passo
