// Converts the command-line arguments for a piece of stock, and reports their errors as messages.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "stock_arguments.hpp"
#include "stock_options.hpp"

#include "passo/cutting/stock_job.hpp"

namespace passo {

// Returns errors of the command line as messages. Does not read `tool_table`.
Result<StockWishes, std::string> stock_wishes(const StockArguments& arguments);
// Adds the shapes of a tool file to the settings. A tool given as an option keeps its shape. Returns false, with a
// message, if the file is invalid.
bool add_tool_shapes(const std::string& path, StockWishes& wishes);

// Calls survey_feeds() and shows the findings as they appear.
FeedLook shown_feeds(const StockJob& job, const StockWishes& wishes, Diagnostics& findings);
// Returns nothing, with a message, if a tool has no shape.
std::optional<std::vector<ToolShape>> shapes_or_message(const StockJob& job, const StockWishes& wishes,
                                                        const FeedLook& look);
// Returns nothing, with a message, if the stock cannot be created.
std::optional<HeightField> field_or_message(const StockWishes& wishes, const FeedLook& look);

}  // namespace passo
