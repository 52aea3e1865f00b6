#include "make_feed.hpp"

#include "passo/drive/direct_feed.hpp"
#include "passo/drive/queue_updater.hpp"

namespace passo {

std::unique_ptr<Feed> make_feed(const FeedStages& stages, const StepOptions& steps, const DriveOptions& options) {
  if (options.tails) {
    auto refiller = std::make_unique<QueueUpdater>(stages, steps, *options.tails, options.waits_for_operator);
    if (options.counts_per_turn > 0) refiller->guard_threads();
    return refiller;
  }
  return std::make_unique<DirectFeed>(stages, DirectFeed::Options{.live = options.live,
                                                                  .follows_spindle = options.counts_per_turn > 0,
                                                                  .waits_for_operator = options.waits_for_operator,
                                                                  .reads_again = options.may_stop_at_lines});
}

}  // namespace passo
