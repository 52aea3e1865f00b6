// FeedStages: what stands above and below a feed.
#pragma once

#include "passo/base/source.hpp"
#include "passo/drive/outputs_order.hpp"
#include "passo/drive/rewindable_path.hpp"
#include "passo/link/link.hpp"
#include "passo/stepgen/step_generator.hpp"
#include "passo/trajectory/planner.hpp"

namespace passo {

struct FeedStages {
  RewindablePath& path;
  Planner& planner;
  StepGenerator& generator;
  Source<BoardItem>& items;  // the generator's, seen by those who watch
  Link& link;
  OutputsOrder& outputs;
};

}  // namespace passo
