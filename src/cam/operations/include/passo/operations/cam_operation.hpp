// CamOperation: one operation of `passo cam`, which generates programs from drawings or pictures, with its options
// (cam_option.hpp). The command line, the API and the web interface are built from this table.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "passo/operations/cam_option.hpp"

namespace passo {

struct CamOperation {
  const char* name;                         // "drill"
  const char* purpose;                      // one line of the help
  const char* accepts;                      // extensions of its input files: ".svg,.dxf"
  const char* examples;                     // examples at the end of the help
  std::vector<CamOption> (*options)();      // returns the options with their default values
  const char* instead_of_files = "";        // the option that replaces the files
  std::span<const char* const> parts = {};  // operations whose options a profile may contain
  const char* picture_ending = ".svg";
};

// Returns the operations in the order in which the web interface offers them. If several operations accept a file, the
// first one is tried.
std::span<const CamOperation> cam_operations();

// Null if there is no operation of this name.
const CamOperation* find_cam_operation(std::string_view name);

// Null if there is no option of this name.
const CamOption* find_option(std::span<const CamOption> options, std::string_view name);

}  // namespace passo
