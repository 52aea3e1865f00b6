// LateLibrary: a shared library that is opened by what needs it, and not by every start (decision 0166). The functions
// of a library stand in one table, a struct with a LateLibrary `library` as its first member:
//
//   struct SomeLibrary {
//     LateLibrary library{PASSO_SOME_NAME};
//     PASSO_FUNCTION(some_open);
//   };
//
// Their types are those of the library's header, so a wrong one does not compile. A library stays open. Private to
// mqtt/.
#pragma once

#include <dlfcn.h>

namespace passo {

class LateLibrary {
 public:
  // What has a name in the library, as a pointer to a function of any type.
  class Found {
   public:
    explicit Found(void* place) : place_(place) {}
    template <class Function>
    operator Function*() const {  // NOLINT(google-explicit-constructor): the type is that of what it is stored in
      return reinterpret_cast<Function*>(place_);
    }

   private:
    void* place_;
  };

  explicit LateLibrary(const char* name)
      : handle_(dlopen(name, RTLD_LAZY | RTLD_LOCAL)), has_all_(handle_ != nullptr) {}

  Found find(const char* name) {
    void* const place = handle_ == nullptr ? nullptr : dlsym(handle_, name);
    has_all_ = has_all_ && place != nullptr;
    return Found(place);
  }
  // Whether the library is there, with all that was looked for.
  bool has_all() const { return has_all_; }

 private:
  void* handle_;
  bool has_all_;
};

// The library of a table: opened by the first call, and kept. Null: this computer has none, or one that lacks a
// function.
template <class Table>
const Table* late_library() {
  static const Table table;
  return table.library.has_all() ? &table : nullptr;
}

}  // namespace passo

// A member with the name and the type of the library's function.
#define PASSO_FUNCTION(name) decltype(&::name) name = library.find(#name)
