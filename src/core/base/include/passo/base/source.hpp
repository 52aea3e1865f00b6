// Source<T>: the interface of a pipeline stage. Each stage pulls its items from the stage before it.
#pragma once

namespace passo {

template <class T>
class Source {
 public:
  virtual ~Source() = default;
  Source() = default;
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  // Writes the next item and returns true. Returns false at the end, and at every call after the end. The caller reuses
  // `item`: a stage overwrites all of it. Text to which an item refers is valid until the next call.
  [[nodiscard]] virtual bool next(T& item) = 0;
};

}  // namespace passo
