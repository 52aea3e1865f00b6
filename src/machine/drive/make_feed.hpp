// Creates the feed for a drive's options. Private to drive/.
#pragma once

#include <memory>

#include "passo/drive/drive_options.hpp"
#include "passo/drive/feed_stages.hpp"

namespace passo {

std::unique_ptr<Feed> make_feed(const FeedStages& stages, const StepOptions& steps, const DriveOptions& options);

}  // namespace passo
