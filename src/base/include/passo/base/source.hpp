// Source<T>: how data walks down the street. Every stage is pulled by the one below it.
#pragma once

namespace passo {

template <class T>
class Source {
 public:
  virtual ~Source() = default;
  Source() = default;
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  // Writes the next item and returns true; returns false at the end, and from then on.
  // `item` is reused by the caller: a stage overwrites all of it, and borrowed text in it lives until the next call.
  [[nodiscard]] virtual bool next(T& item) = 0;
};

}  // namespace passo
