// What the command line says of a piece of stock that is cut, and what of it is wrong, as messages.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "stock_arguments.hpp"
#include "stock_options.hpp"

#include "passo/cutting/stock_job.hpp"

namespace passo {

// The refusals of the command line come as messages. `tool_table` is not read.
Result<StockWishes, std::string> stock_wishes(const StockArguments& arguments);
// Reads a file of tools into the wishes. A tool of an option keeps its shape. False, with a message: the file is wrong.
bool add_tool_shapes(const std::string& path, StockWishes& wishes);

// survey_feeds() that shows the findings as they come.
FeedLook shown_feeds(const StockJob& job, const StockWishes& wishes, Diagnostics& findings);
// Nothing, with a message: a tool has no shape.
std::optional<std::vector<ToolShape>> shapes_or_message(const StockJob& job, const StockWishes& wishes,
                                                        const FeedLook& look);
// Nothing, with a message: there is no such stock.
std::optional<HeightField> field_or_message(const StockWishes& wishes, const FeedLook& look);

}  // namespace passo
