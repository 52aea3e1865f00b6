// The version of libpasso's interface.
//
// All names are in `passo::v1`. `passo::x` means `passo::v1::x` as long as version 1 is the current one. `passo::v1::x`
// always has the same meaning. docs/library.md states what a new version may change.
#pragma once

// The version of the interface. It changes only if programs must be changed.
#define PASSO_LIBRARY_INTERFACE 1

#if defined(__GNUC__)
#define PASSO_EXPORTED __attribute__((visibility("default")))
#else
#define PASSO_EXPORTED
#endif

namespace passo::v1 {

// Returns the version of the library in use, e.g. "1.0.0". CMake's variable `passo_VERSION` has the version with which
// a program was compiled.
PASSO_EXPORTED const char* library_version();

}  // namespace passo::v1

// The sources of the library see the inner names of `passo` as well.
#ifndef PASSO_LIBRARY_SOURCES
namespace passo {
using namespace v1;  // NOLINT(google-build-using-namespace): the current version
}  // namespace passo
#endif
