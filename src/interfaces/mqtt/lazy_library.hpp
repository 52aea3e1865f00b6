// LazyLibrary: a shared library that is loaded on first use instead of at program start (decision 0166). The functions
// of a library are members of a table, a struct with a LazyLibrary `library` as its first member:
//
//   struct SomeLibrary {
//     LazyLibrary library{PASSO_SOME_NAME};
//     PASSO_FUNCTION(some_open);
//   };
//
// Their types are those of the library's header, so a wrong type does not compile. A library stays loaded. Private to
// mqtt/.
#pragma once

#include <dlfcn.h>

namespace passo {

class LazyLibrary {
 public:
  // A symbol of the library, convertible to a pointer to any function type.
  class Found {
   public:
    explicit Found(void* place) : place_(place) {}
    template <class Function>
    operator Function*() const {  // NOLINT(google-explicit-constructor): converts to the type of the variable it is
                                  // assigned to
      return reinterpret_cast<Function*>(place_);
    }

   private:
    void* place_;
  };

  explicit LazyLibrary(const char* name)
      : handle_(dlopen(name, RTLD_LAZY | RTLD_LOCAL)), has_all_(handle_ != nullptr) {}

  Found find(const char* name) {
    void* const place = handle_ == nullptr ? nullptr : dlsym(handle_, name);
    has_all_ = has_all_ && place != nullptr;
    return Found(place);
  }
  // Returns whether the library was found, with all requested functions.
  bool has_all() const { return has_all_; }

 private:
  void* handle_;
  bool has_all_;
};

// Returns the library of a table, which is loaded by the first call and kept. Null if this computer has none, or if it
// lacks a function.
template <class Table>
const Table* lazy_library() {
  static const Table table;
  return table.library.has_all() ? &table : nullptr;
}

}  // namespace passo

// Declares a member with the name and the type of the library's function.
#define PASSO_FUNCTION(name) decltype(&::name) name = library.find(#name)
